// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/window/ui_fonts.h"

#include <imgui.h>

#include <cmath>
#include <filesystem>

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

}  // namespace

UiFonts loadUiFonts(float scale, UiDensity density) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  UiFonts fonts;
  const bool study = density == UiDensity::Study;
  fonts.bodyPx = std::round((study ? kBodyPx : kWorkbenchBodyPx) * scale);
  fonts.titlePx = std::round((study ? kTitlePx : kWorkbenchTitlePx) * scale);
  fonts.path = findFont();
  if (!fonts.path.empty()) {
    fonts.body = atlas.AddFontFromFileTTF(fonts.path.c_str(), fonts.bodyPx, nullptr, kRanges);
    fonts.title = atlas.AddFontFromFileTTF(fonts.path.c_str(), fonts.titlePx, nullptr, kRanges);
    fonts.arrows = true;
    return fonts;
  }
  ImFontConfig config;
  config.SizePixels = fonts.bodyPx;
  fonts.body = atlas.AddFontDefault(&config);
  config.SizePixels = fonts.titlePx;
  fonts.title = atlas.AddFontDefault(&config);
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
