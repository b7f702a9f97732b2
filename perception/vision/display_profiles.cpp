// SPDX-License-Identifier: BSD-3-Clause
//
// Displays by name and from files. A file:
//
//     # 24 in desktop display, calibrated 2024-05-01
//     name: lab_left
//     resolution_px: [1920, 1080]
//     diagonal_in: 24               # or size_m: [0.531, 0.299]
//     distance_m: 0.6
//     black_cd_m2: 0.25             # measured in the dark
//     peak_cd_m2: 250
//     ambient_lux: 200              # on the screen; 0 if left out
//     screen_reflectance: 0.005     # diffuse; 0.005 if left out
//     transfer: srgb                # or gamma (with `gamma`), linear; srgb if left out
//     refresh_hz: 60                # 60 if left out
#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "experiments/base/error.h"
#include "experiments/base/input_files.h"
#include "experiments/base/text.h"
#include "perception/vision/display.h"
#include "perception/vision/display_yaml.h"

namespace limen::perception {
namespace {

namespace fs = std::filesystem;

constexpr double kInchM = 0.0254;
constexpr uintmax_t kMaxBytes = 64 << 10;  ///< a profile is written by hand

const std::vector<std::string>& keys() {
  static const std::vector<std::string> kKeys = {"name",        "resolution_px", "size_m",
                                                 "diagonal_in", "distance_m",    "black_cd_m2",
                                                 "peak_cd_m2",  "ambient_lux",   "screen_reflectance",
                                                 "transfer",    "gamma",         "refresh_hz"};
  return kKeys;
}

struct CurveName {
  TransferCurve curve;
  const char* name;
};
constexpr CurveName kCurves[] = {
    {TransferCurve::Srgb, "srgb"}, {TransferCurve::Gamma, "gamma"}, {TransferCurve::Linear, "linear"}};

void setDiagonal(DisplayProfile& profile, double inches) {
  const double pixels = std::hypot(profile.resolutionPx.x, profile.resolutionPx.y);
  profile.widthM = inches * kInchM * profile.resolutionPx.x / pixels;
  profile.heightM = inches * kInchM * profile.resolutionPx.y / pixels;
}

struct Preset {
  const char* name;
  glm::ivec2 resolutionPx;
  double diagonalIn, distanceM, blackCdM2, peakCdM2, ambientLux, screenReflectance;
  TransferCurve transfer;
  double gamma, refreshHz;
  const char* reason;
};

// Reflectances are those of the diffuse part for matt (0.01) and glossy coated screens (0.005).
constexpr Preset kPresets[] = {
    {"schwarz_2009",
     {1600, 1200},
     20.0,
     0.6,
     0.5,
     250.0,
     0.0,
     0.005,
     TransferCurve::Srgb,
     2.2,
     60.0,
     "study of Schwarz 2009, section 10.4: 20 in 4:3 LCD at 60 cm. The thesis names neither levels nor "
     "refresh "
     "rate: 0.5 and 250 cd/m2 are those of a desktop LCD of 2009 (500:1), 60 Hz its rate"},
    {"desktop_24",
     {1920, 1080},
     24.0,
     0.6,
     0.25,
     250.0,
     200.0,
     0.01,
     TransferCurve::Srgb,
     2.2,
     60.0,
     "most common desktop display: matt IPS panel of 1000:1 in an office (ISO 9241: 500 lux on the desk, "
     "less "
     "on "
     "the upright screen)"},
    {"desktop_27_4k",
     {3840, 2160},
     27.0,
     0.6,
     0.35,
     350.0,
     200.0,
     0.01,
     TransferCurve::Srgb,
     2.2,
     60.0,
     "high-resolution desktop display of 1000:1 in an office"},
    {"hdr_monitor_32_4k",
     {3840, 2160},
     32.0,
     0.7,
     0.005,
     1000.0,
     10.0,
     0.01,
     TransferCurve::Linear,
     2.2,
     120.0,
     "local dimming to VESA DisplayHDR 1000 (1000 cd/m2) in a dim grading room (ITU-R BT.2100: 5 cd/m2 "
     "surround); values are light, 1 is peak"},
    {"laptop_14",
     {1920, 1200},
     14.0,
     0.5,
     0.3,
     300.0,
     200.0,
     0.01,
     TransferCurve::Srgb,
     2.2,
     60.0,
     "14 in 16:10 notebook, matt, 1000:1, in an office"},
    {"phone_6",
     {1170, 2532},
     6.1,
     0.3,
     0.001,
     600.0,
     200.0,
     0.005,
     TransferCurve::Srgb,
     2.2,
     60.0,
     "OLED phone of 457 pixels per inch held at 30 cm indoors"},
    {"projector",
     {1920, 1080},
     100.0,
     3.0,
     0.024,
     48.0,
     0.0,
     1.0,
     TransferCurve::Gamma,
     2.6,
     60.0,
     "dark room, 2.2 m wide picture at 3 m, white and gamma of digital cinema (SMPTE RP 431-2: 48 cd/m2, "
     "2.6; contrast 2000:1); a projection screen returns all ambient light"},
    {"tv_55_4k",
     {3840, 2160},
     55.0,
     2.5,
     0.001,
     200.0,
     10.0,
     0.005,
     TransferCurve::Gamma,
     2.4,
     60.0,
     "OLED television in a dim living room, transfer of ITU-R BT.1886"},
};

const Preset* findPreset(const std::string& name) {
  for (const Preset& preset : kPresets)
    if (name == preset.name) return &preset;
  return nullptr;
}

std::string readWhole(const std::string& path) {
  std::error_code error;
  const uintmax_t bytes = fs::file_size(path, error);
  if (error || !fs::is_regular_file(path, error))
    throw Error("is not a readable file", path, "give a display profile (YAML) or a preset");
  if (bytes > kMaxBytes) throw Error("is too large for a display profile", path);
  std::ifstream file(path, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file.is_open() || file.bad()) throw Error("cannot be read", path);
  return text;
}

/// Reads the members of one map, each with its line in errors.
class Reader {
 public:
  Reader(const std::string& text, const std::string& path) : path_(path) {
    try {
      root_ = YAML::Load(text);
    } catch (const YAML::Exception& error) {
      throw Error(error.msg, at(error.mark), "a display profile is a list of 'key: value'");
    }
    if (!root_.IsMap()) throw Error("holds no map", path, "a display profile is a list of 'key: value'");
    std::set<std::string> seen;
    for (const auto& member : root_) {
      const std::string key = member.first.IsScalar() ? member.first.Scalar() : "";
      if (std::find(keys().begin(), keys().end(), key) == keys().end())
        throw Error("unknown key '" + key + "'", at(member.first.Mark()), suggest(key, keys()));
      if (!seen.insert(key).second)
        throw Error("'" + key + "' is given twice", at(member.first.Mark()), "keep one");
    }
  }

  bool has(const char* key) const { return static_cast<bool>(root_[key]); }
  std::string where(const char* key) const { return has(key) ? at(root_[key].Mark()) : path_; }

  double number(const char* key) const { return toNumber(need(key), key); }
  double number(const char* key, double otherwise) const { return has(key) ? number(key) : otherwise; }

  glm::dvec2 pair(const char* key) const {
    const YAML::Node node = need(key);
    if (!node.IsSequence() || node.size() != 2)
      throw Error(fmt::format("'{}' is not a pair", key), at(node.Mark()), "give [width, height]");
    return {toNumber(node[0], key), toNumber(node[1], key)};
  }

  std::string text(const char* key) const {
    const YAML::Node node = need(key);
    if (!node.IsScalar()) throw Error(fmt::format("'{}' is not a text", key), at(node.Mark()));
    return node.Scalar();
  }

 private:
  std::string at(const YAML::Mark& mark) const {
    return mark.is_null() ? path_ : fmt::format("{}:{}:{}", path_, mark.line + 1, mark.column + 1);
  }

  YAML::Node need(const char* key) const {
    if (has(key)) return root_[key];
    throw Error(fmt::format("'{}' is missing", key), path_, "models need it; no value can be assumed");
  }

  double toNumber(const YAML::Node& node, const char* key) const {
    double value = 0.0;
    if (!node.IsScalar() || !YAML::convert<double>::decode(node, value) || !std::isfinite(value))
      throw Error(fmt::format("'{}' is {}", key, node.IsScalar() ? "'" + node.Scalar() + "'" : "no number"),
                  at(node.Mark()), "give a number");
    return value;
  }

  std::string path_;
  YAML::Node root_;
};

DisplayProfile profileOf(const std::string& text, const std::string& path) {
  const Reader file(text, path);
  DisplayProfile out;
  out.name = file.has("name") ? file.text("name") : fs::path(path).stem().string();
  const glm::dvec2 resolution = file.pair("resolution_px");
  for (int i = 0; i < 2; ++i) {
    if (!(resolution[i] >= 1.0 && resolution[i] <= 65536.0) || resolution[i] != std::trunc(resolution[i]))
      throw Error(fmt::format("'resolution_px' is {}", shortestNumber(resolution[i])),
                  file.where("resolution_px"), "give whole numbers from 1 to 65536");
    out.resolutionPx[i] = static_cast<int>(resolution[i]);
  }
  if (file.has("size_m") && file.has("diagonal_in"))
    throw Error("'size_m' and 'diagonal_in' are both given", file.where("diagonal_in"), "keep one");
  if (file.has("diagonal_in")) {
    setDiagonal(out, file.number("diagonal_in"));
  } else if (file.has("size_m")) {
    const glm::dvec2 size = file.pair("size_m");
    out.widthM = size.x, out.heightM = size.y;
  } else {
    throw Error("'size_m' is missing", path, "give [width, height] of the lit area, or 'diagonal_in'");
  }
  out.distanceM = file.number("distance_m");
  out.blackCdM2 = file.number("black_cd_m2");
  out.peakCdM2 = file.number("peak_cd_m2");
  out.ambientLux = file.number("ambient_lux", out.ambientLux);
  out.screenReflectance = file.number("screen_reflectance", out.screenReflectance);
  out.refreshHz = file.number("refresh_hz", out.refreshHz);
  if (file.has("transfer")) {
    const std::string name = file.text("transfer");
    const auto* curve = std::find_if(std::begin(kCurves), std::end(kCurves),
                                     [&](const CurveName& one) { return name == one.name; });
    if (curve == std::end(kCurves))
      throw Error("'transfer' is '" + name + "'", file.where("transfer"),
                  suggest(name, {"srgb", "gamma", "linear"}));
    out.transfer = curve->curve;
  }
  if (out.transfer == TransferCurve::Gamma) {
    out.gamma = file.number("gamma");
  } else if (file.has("gamma")) {
    throw Error("'gamma' without 'transfer: gamma'", file.where("gamma"), "give the one that is meant");
  }
  // checkDisplay() names the key; its line is looked up again for the message.
  try {
    checkDisplay(out, path);
  } catch (const Error& error) {
    for (const std::string& key : keys())
      if (error.message().rfind("'" + key + "'", 0) == 0)
        throw Error(error.message(), file.where(key.c_str()), error.hint());
    throw Error(error.message(), file.where(file.has("size_m") ? "size_m" : "diagonal_in"), error.hint());
  }
  return out;
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out + "\"";
}

}  // namespace

std::vector<std::string> displayPresets() {
  std::vector<std::string> out;
  for (const Preset& preset : kPresets) out.emplace_back(preset.name);
  return out;
}

DisplayProfile displayPreset(const std::string& name) {
  const Preset* preset = findPreset(name);
  if (preset == nullptr) throw Error("no display '" + name + "'", "", suggest(name, displayPresets()));
  DisplayProfile out;
  out.name = preset->name;
  out.resolutionPx = preset->resolutionPx;
  setDiagonal(out, preset->diagonalIn);
  out.distanceM = preset->distanceM;
  out.blackCdM2 = preset->blackCdM2;
  out.peakCdM2 = preset->peakCdM2;
  out.ambientLux = preset->ambientLux;
  out.screenReflectance = preset->screenReflectance;
  out.transfer = preset->transfer;
  out.gamma = preset->gamma;
  out.refreshHz = preset->refreshHz;
  return out;
}

std::string displayPresetReason(const std::string& name) {
  const Preset* preset = findPreset(name);
  return preset == nullptr ? std::string() : preset->reason;
}

DisplayProfile readDisplay(const std::string& nameOrFile) {
  if (findPreset(nameOrFile) != nullptr) return displayPreset(nameOrFile);
  std::error_code error;
  if (!fs::exists(nameOrFile, error) && nameOrFile.find_first_of("/.") == std::string::npos)
    throw Error("no display '" + nameOrFile + "', nor a file of that name", "",
                suggest(nameOrFile, displayPresets()));
  protectInput(nameOrFile);
  return profileOf(readWhole(nameOrFile), nameOrFile);
}

DisplayProfile displayFromYaml(const std::string& text, const std::string& where) {
  return profileOf(text, where);
}

std::string toYaml(const DisplayProfile& profile) {
  std::string out;
  if (!profile.name.empty()) out += "name: " + quoted(profile.name) + "\n";
  const auto add = [&](const char* key, double value) {
    out += fmt::format("{}: {}\n", key, shortestNumber(value));
  };
  out += fmt::format("resolution_px: [{}, {}]\n", profile.resolutionPx.x, profile.resolutionPx.y);
  out += fmt::format("size_m: [{}, {}]\n", shortestNumber(profile.widthM), shortestNumber(profile.heightM));
  add("distance_m", profile.distanceM);
  add("black_cd_m2", profile.blackCdM2);
  add("peak_cd_m2", profile.peakCdM2);
  add("ambient_lux", profile.ambientLux);
  add("screen_reflectance", profile.screenReflectance);
  for (const CurveName& one : kCurves)
    if (profile.transfer == one.curve) out += fmt::format("transfer: {}\n", one.name);
  // Without effect otherwise, and so not part of the hash.
  if (profile.transfer == TransferCurve::Gamma) add("gamma", profile.gamma);
  add("refresh_hz", profile.refreshHz);
  return out;
}

}  // namespace limen::perception
