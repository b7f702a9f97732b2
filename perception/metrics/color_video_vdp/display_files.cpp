// SPDX-License-Identifier: BSD-3-Clause
// Displays and colour spaces in the authors' JSON form.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "perception/metrics/color_video_vdp/display.h"

namespace limen::embedded {
extern const char* const kCvvdpDisplays;
extern const char* const kCvvdpColourSpaces;
}  // namespace limen::embedded

namespace limen::perception::cvvdp {
namespace {

using nlohmann::json;

constexpr double kInchM = 0.0254;

json parseFile(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw Error("cannot read '" + path + "'", {}, "give a JSON file of displays or colour spaces");
  try {
    json out = json::parse(in);
    if (out.is_object()) return out;
  } catch (const json::exception& error) {
    throw Error(error.what(), path, "give JSON in the form of ColorVideoVDP's display_models.json");
  }
  throw Error("holds no JSON object", path, "give JSON in the form of ColorVideoVDP's display_models.json");
}

const json& publishedDisplays() {
  static const json kDisplays = json::parse(embedded::kCvvdpDisplays);
  return kDisplays;
}

std::vector<std::string> namesIn(const json& table) {
  std::vector<std::string> names;
  for (const auto& [name, entry] : table.items())
    if (entry.is_object()) names.push_back(name);
  return names;
}

/// An entry of a table with its place, for errors.
class Entry {
 public:
  Entry(const json& entry, std::string where) : entry_(entry), where_(std::move(where)) {}

  bool has(const char* key) const { return entry_.contains(key); }
  double number(const char* key) const {
    const auto found = entry_.find(key);
    if (found == entry_.end() || !found->is_number() || !std::isfinite(found->get<double>()))
      throw Error(std::string("'") + key + "' must be a number", where_, "state it");
    return found->get<double>();
  }
  double number(const char* key, double otherwise) const { return has(key) ? number(key) : otherwise; }
  std::vector<double> numbers(const char* key, size_t count) const {
    const auto found = entry_.find(key);
    const bool good = found != entry_.end() && found->is_array() && found->size() == count &&
                      std::all_of(found->begin(), found->end(), [](const json& v) { return v.is_number(); });
    if (!good)
      throw Error(std::string("'") + key + "' must be " + std::to_string(count) + " numbers", where_,
                  "state it");
    return found->get<std::vector<double>>();
  }
  std::string text(const char* key, const std::string& otherwise) const {
    if (!has(key)) return otherwise;
    if (!entry_.at(key).is_string())
      throw Error(std::string("'") + key + "' must be a text", where_, "write it in quotes");
    return entry_.at(key).get<std::string>();
  }
  [[noreturn]] void refuse(const std::string& what, const std::string& hint) const {
    throw Error(what, where_, hint);
  }

 private:
  const json& entry_;
  std::string where_;
};

Entry find(const json& table, const std::string& name, const char* kind, const std::string& file) {
  if (!table.contains(name) || !table.at(name).is_object())
    throw Error(std::string("no ") + kind + " '" + name + "'", file, suggest(name, namesIn(table)));
  return {table.at(name), (file.empty() ? "" : file + ": ") + std::string(kind) + " '" + name + "'"};
}

ColourSpace readColourSpace(const std::string& name, const std::string& file) {
  const json table = file.empty() ? json::parse(embedded::kCvvdpColourSpaces) : parseFile(file);
  const Entry entry = find(table, name, "colour space", file);
  ColourSpace out;
  out.name = name;
  const std::string eotf = entry.text("EOTF", "");
  if (eotf == "sRGB") {
    out.eotf = Eotf::Srgb;
  } else if (eotf == "PQ") {
    out.eotf = Eotf::Pq;
  } else if (eotf == "linear") {
    out.eotf = Eotf::Linear;
  } else if (eotf == "HLG") {
    out.eotf = Eotf::Hlg;
  } else {
    out.eotf = Eotf::Power;
    char* end = nullptr;
    out.exponent = std::strtod(eotf.c_str(), &end);
    if (eotf.empty() || *end != '\0' || !(out.exponent > 0.0 && out.exponent < 100.0))
      entry.refuse("'EOTF' is '" + eotf + "'", "give sRGB, PQ, HLG, linear or an exponent such as \"2.2\"");
  }
  if (!entry.has("RGB2X"))
    entry.refuse("has no primaries", "colour images need a colour space with RGB2X, RGB2Y and RGB2Z");
  for (int row = 0; row < 3; ++row) {
    constexpr const char* kRows[3] = {"RGB2X", "RGB2Y", "RGB2Z"};
    const std::vector<double> numbers = entry.numbers(kRows[row], 3);
    for (int column = 0; column < 3; ++column) out.xyzOfRgb[column][row] = numbers[static_cast<size_t>(column)];
  }
  return out;
}

double readPixelsPerDegree(const Entry& entry) {
  if (entry.has("pixels_per_degree")) return entry.number("pixels_per_degree");
  const std::vector<double> resolution = entry.numbers("resolution", 2);
  const double aspect = resolution[0] / resolution[1];
  std::optional<double> distanceM, widthM;
  if (entry.has("viewing_distance_meters")) distanceM = entry.number("viewing_distance_meters");
  if (entry.has("viewing_distance_inches")) distanceM = kInchM * entry.number("viewing_distance_inches");
  std::optional<double> diagonalM;
  if (entry.has("diagonal_size_meters")) diagonalM = entry.number("diagonal_size_meters");
  if (entry.has("diagonal_size_inches")) diagonalM = kInchM * entry.number("diagonal_size_inches");
  if (diagonalM) widthM = aspect * *diagonalM / std::sqrt(1.0 + aspect * aspect);
  if (entry.has("fov_diagonal")) {
    // Pixels per degree do not depend on the distance then.
    if (!distanceM) distanceM = 1.0;
    const double halfDiagonalPx = std::tan(0.5 * entry.number("fov_diagonal") * std::numbers::pi / 180.0);
    const double distancePx = std::hypot(resolution[0], resolution[1]) / (2.0 * halfDiagonalPx);
    widthM = aspect * 2.0 * *distanceM * 0.5 * resolution[1] / distancePx;
  }
  if (entry.has("viewing_distance_heights")) {
    const double heights = entry.number("viewing_distance_heights");
    if (!widthM) widthM = aspect;
    distanceM = heights * *widthM / aspect;
  }
  if (!distanceM || !widthM)
    entry.refuse("states no viewing distance or no size",
                 "give viewing_distance_meters or viewing_distance_inches, and diagonal_size_inches or "
                 "fov_diagonal");
  const double pixelDegrees =
      2.0 * std::atan(0.5 * *widthM / (resolution[0] * *distanceM)) * 180.0 / std::numbers::pi;
  return 1.0 / pixelDegrees;
}

void check(const Display& display, const Entry& entry) {
  if (!(display.peakCdM2 > 0.0)) entry.refuse("the peak luminance is not positive", "give max_luminance");
  if (!(display.blackCdM2 >= 0.0 && display.blackCdM2 < display.peakCdM2))
    entry.refuse("black is not between 0 and the peak", "check contrast or min_luminance");
  if (!(display.ambientLux >= 0.0 && display.reflectivity >= 0.0 && display.exposure > 0.0))
    entry.refuse("room or exposure is impossible", "E_ambient and k_refl are at least 0, exposure is above");
  if (!(display.pixelsPerDegree > 0.4 && display.pixelsPerDegree < 1e4))
    entry.refuse("pixels per degree come out as " + shortestNumber(display.pixelsPerDegree),
                 "check resolution, size and viewing distance");
  if (display.colours.eotf == Eotf::Hlg && display.peakCdM2 > 1000.0 && !(display.ambientLux > 0.0))
    entry.refuse("HLG above 1000 cd/m2 is not defined in a dark room", "give E_ambient above 0");
}

}  // namespace

std::vector<std::string> displayNames() { return namesIn(publishedDisplays()); }

Display readDisplay(const std::string& name, const DisplayFiles& files) {
  const json& published = publishedDisplays();
  if (files.displays.empty() && !published.contains(name)) {
    const std::vector<std::string> presets = displayPresets();
    const bool isProfile = std::find(presets.begin(), presets.end(), name) != presets.end() ||
                           name.find_first_of("./") != std::string::npos;
    if (isProfile) return displayOf(perception::readDisplay(name));
    std::vector<std::string> known = namesIn(published);
    known.insert(known.end(), presets.begin(), presets.end());
    throw Error("no display '" + name + "'", {}, suggest(name, known));
  }
  const json table = files.displays.empty() ? json() : parseFile(files.displays);
  const Entry entry = find(files.displays.empty() ? published : table, name, "display", files.displays);
  Display out;
  out.name = name;
  out.peakCdM2 = entry.number("max_luminance");
  out.blackCdM2 = entry.has("min_luminance") ? entry.number("min_luminance")
                                             : out.peakCdM2 / entry.number("contrast", 500.0);
  out.ambientLux = entry.number("E_ambient", 0.0);
  out.reflectivity = entry.number("k_refl", 0.005);
  out.exposure = entry.number("exposure", 1.0);
  out.colours = readColourSpace(entry.text("colorspace", "sRGB"), files.colourSpaces);
  out.pixelsPerDegree = readPixelsPerDegree(entry);
  check(out, entry);
  return out;
}

}  // namespace limen::perception::cvvdp
