// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/window/ui_fonts.h"

#include <imgui.h>

#include <array>
#include <cmath>
#include <deque>
#include <filesystem>
#include <fstream>
#include <vector>

#include "experiments/base/error.h"

namespace limen::window {
namespace {

// 22 px are 5.6 mm on a display of 0.25 mm pitch: 0.5 degrees at 60 cm, three times what a reader with normal
// vision needs.
constexpr float kBodyPx = 22.0F, kTitlePx = 34.0F;
constexpr float kWorkbenchBodyPx = 15.0F, kWorkbenchTitlePx = 18.0F;

std::string findFont() {
  for (const char* folder :
       {"/usr/share/fonts/truetype/dejavu", "/usr/share/fonts/dejavu", "/usr/share/fonts/dejavu-sans-fonts",
        "/usr/share/fonts/TTF", "/usr/local/share/fonts"}) {
    const std::filesystem::path path = std::filesystem::path(folder) / "DejaVuSans.ttf";
    std::error_code ignored;
    if (std::filesystem::is_regular_file(path, ignored)) return path.string();
  }
  return "";
}

// Pairs of first and last character, for the scripts that protocols are likely to use.
const ImWchar kRanges[] = {0x0020, 0x024F, 0x0370, 0x052F, 0x2010, 0x2027, 0x2030, 0x205E, 0x2190, 0x2193, 0};

// Fonts with the scripts of East Asia, by the places where Debian's packages put them.
std::vector<std::string> wideFonts() {
  std::vector<std::string> out;
  for (const char* path :
       {"/usr/share/fonts/opentype/noto/NotoSansCJK-Regular.ttc",
        "/usr/share/fonts/opentype/ipafont-gothic/ipag.ttf", "/usr/share/fonts/opentype/unifont/unifont.otf",
        "/usr/share/fonts/truetype/unifont/unifont.ttf"}) {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(path, ignored)) out.emplace_back(path);
  }
  return out;
}

/// Dear ImGui ends the program at a file that is no font.
void requireFont(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::array<char, 4> begin{};
  in.read(begin.data(), begin.size());
  const std::string tag(begin.data(), begin.size());
  if (!in || (tag != std::string("\0\1\0\0", 4) && tag != "OTTO" && tag != "ttcf" && tag != "true"))
    throw Error("is not a TrueType or OpenType font", path, "name a file that ends with .ttf, .otf or .ttc");
}

/// As Dear ImGui takes them: pairs of first and last, then 0. The atlas reads them when it is built, so they
/// must live on.
const ImWchar* rangesOf(const std::u32string& characters) {
  static std::deque<std::vector<ImWchar>> kept;
  std::vector<ImWchar>& ranges = kept.emplace_back();
  for (const char32_t c : characters)
    if (c >= 0x20 && c <= 0xFFFF) ranges.insert(ranges.end(), 2, static_cast<ImWchar>(c));
  ranges.push_back(0);
  return ranges.data();
}

/// A font of a size with what fonts after the first add to it.
ImFont* addFont(ImFontAtlas& atlas, const std::string& path, float px, const UiLettering& lettering) {
  ImFont* font = nullptr;
  if (path.empty()) {
    ImFontConfig config;
    config.SizePixels = px;
    font = atlas.AddFontDefault(&config);
  } else {
    font = atlas.AddFontFromFileTTF(path.c_str(), px, nullptr, kRanges);
  }
  const ImWchar* ranges = rangesOf(lettering.characters);
  if (ranges[0] == 0) return font;
  std::vector<std::string> more;
  if (!path.empty()) more.push_back(path);
  if (!lettering.fontFile.empty()) {
    requireFont(lettering.fontFile);
    more.push_back(lettering.fontFile);
  }
  for (const std::string& wide : wideFonts()) more.push_back(wide);
  ImFontConfig config;
  config.MergeMode = true;  // what is there stays
  for (const std::string& file : more) atlas.AddFontFromFileTTF(file.c_str(), px, &config, ranges);
  return font;
}

}  // namespace

std::u32string lackingCharacters(const UiLettering& lettering) {
  ImFontAtlas atlas;
  constexpr float kSmallPx = 8.0F;  // only which there are matters
  const ImFont* font = addFont(atlas, findFont(), kSmallPx, lettering);
  atlas.Build();
  std::u32string out;
  for (const char32_t c : lettering.characters)
    if (c > 0xFFFF || (c >= 0x20 && !font->FindGlyphNoFallback(static_cast<ImWchar>(c)))) out += c;
  return out;
}

UiFonts loadUiFonts(float scale, UiDensity density, const UiLettering& lettering) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  UiFonts fonts;
  const bool study = density == UiDensity::Study;
  fonts.bodyPx = std::round((study ? kBodyPx : kWorkbenchBodyPx) * scale);
  fonts.titlePx = std::round((study ? kTitlePx : kWorkbenchTitlePx) * scale);
  fonts.path = findFont();
  fonts.body = addFont(atlas, fonts.path, fonts.bodyPx, lettering);
  fonts.title = addFont(atlas, fonts.path, fonts.titlePx, lettering);
  fonts.arrows = !fonts.path.empty();
  return fonts;
}

void styleUi(float scale, UiDensity density) {
  ImGuiStyle& style = ImGui::GetStyle();
  style = ImGuiStyle();
  ImGui::StyleColorsDark(&style);
  if (density == UiDensity::Study) {
    style.FramePadding = {12, 8};
    style.ItemSpacing = {12, 10};
    style.WindowPadding = {20, 20};
    style.FrameRounding = 6;
  } else {
    style.FramePadding = {6, 3};
    style.ItemSpacing = {6, 4};
    style.WindowPadding = {8, 8};
    style.FrameRounding = 3;
    style.GrabMinSize = 8;
  }
  style.Colors[ImGuiCol_Text] = {0.95F, 0.95F, 0.95F, 1};
  style.Colors[ImGuiCol_Button] = {0.26F, 0.28F, 0.32F, 1};
  style.Colors[ImGuiCol_ButtonHovered] = {0.33F, 0.38F, 0.46F, 1};
  style.Colors[ImGuiCol_ButtonActive] = {0.20F, 0.45F, 0.70F, 1};
  style.ScaleAllSizes(scale);
}

}  // namespace limen::window
