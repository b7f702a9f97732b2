// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>

#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "perception/command/model_commands.h"
#include "perception/vision/display.h"
#include "perception/vision/eye_movement.h"

namespace limen::perception {
namespace {

struct DisplayOptions {
  std::string display, at, velocity, window;
  bool list = false, json = false, yaml = false;
};

struct Eye {
  const char* name;
  EyeMovement model;
};
constexpr Eye kEyes[] = {{"literal", EyeMovement::Literal},
                         {"floor", EyeMovement::Floor},
                         {"monotone", EyeMovement::Monotone},
                         {"none", EyeMovement::None}};

double fieldDeg(const DisplayProfile& display, double px) {
  return 2.0 * std::atan(0.5 * px * display.pitchM() / display.distanceM) * 180.0 / std::numbers::pi;
}

nlohmann::json derived(const DisplayProfile& display) {
  const double ppd = display.pixelsPerDegree();
  return {
      {"name", display.name},
      {"resolution_px", {display.resolutionPx.x, display.resolutionPx.y}},
      {"size_m", {display.widthM, display.heightM}},
      {"distance_m", display.distanceM},
      {"pitch_mm", 1000.0 * display.pitchM()},
      {"pixels_per_degree", ppd},
      {"pixels_per_degree_edge", display.pixelsPerDegreeAt(0.5 * display.resolutionPx.x)},
      {"nyquist_cpd", 0.5 * ppd},
      {"field_deg", {fieldDeg(display, display.resolutionPx.x), fieldDeg(display, display.resolutionPx.y)}},
      {"area_deg2", display.areaDeg2(glm::dvec2(display.resolutionPx))},
      {"one_degree_level", std::log2(ppd)},
      {"reflected_cd_m2", display.reflectedCdM2()},
      {"black_level_cd_m2", display.blackLevelCdM2()},
      {"white_level_cd_m2", display.whiteLevelCdM2()},
      {"refresh_hz", display.refreshHz},
      {"reason", displayPresetReason(display.name)},
      {"hash", display.hash()}};
}

void printDisplays(bool json) {
  nlohmann::json list = nlohmann::json::array();
  for (const std::string& name : displayPresets()) {
    const DisplayProfile display = displayPreset(name);
    list.push_back(derived(display));
    if (!json) std::printf("%s\n  %s\n", display.line().c_str(), displayPresetReason(name).c_str());
  }
  if (json) printJson({{"displays", list}});
}

double pixels(const std::string& text, const std::string& option) {
  const double value = readNumber(text, option);
  if (value >= 0.0) return value;
  throw Error("'" + text + "' is negative", option, "give pixels");
}

nlohmann::json moving(const DisplayProfile& display, double displacementPx, double ppd) {
  const double screen = screenVelocityDegS(displacementPx, display.refreshHz, ppd);
  nlohmann::json out = {{"displacement_px_per_frame", displacementPx}, {"screen_deg_s", screen}};
  for (const Eye& eye : kEyes) out["retinal_deg_s"][eye.name] = retinalVelocityDegS(screen, eye.model);
  return out;
}

void runDisplay(const DisplayOptions& options) {
  if (options.list || options.display.empty()) return printDisplays(options.json);
  const DisplayProfile display = readDisplay(options.display);
  if (options.yaml) {
    std::printf("%s", toYaml(display).c_str());
    return;
  }
  nlohmann::json out = derived(display);
  double ppd = display.pixelsPerDegree();
  if (!options.at.empty()) {
    const double offset = pixels(options.at, "--at");
    ppd = display.pixelsPerDegreeAt(offset);
    out["at"] = {{"offset_px", offset}, {"pixels_per_degree", ppd}, {"nyquist_cpd", 0.5 * ppd}};
  }
  if (!options.velocity.empty()) out["motion"] = moving(display, pixels(options.velocity, "--velocity"), ppd);
  if (options.json) return printJson(out);
  std::printf("%s\n", display.line().c_str());
  if (const std::string reason = displayPresetReason(display.name); !reason.empty())
    std::printf("  %s\n", reason.c_str());
  const auto line = [](const char* what, const std::string& value) {
    std::printf("%-26s %s\n", what, value.c_str());
  };
  line("pixel pitch", readable(1000.0 * display.pitchM()) + " mm");
  line("pixels per degree, centre", readable(display.pixelsPerDegree()));
  line("pixels per degree, edge", readable(display.pixelsPerDegreeAt(0.5 * display.resolutionPx.x)));
  if (!options.at.empty()) line(("pixels per degree, " + options.at + " px off").c_str(), readable(ppd));
  line("Nyquist frequency", readable(0.5 * display.pixelsPerDegree()) + " cpd");
  line("field of view",
       fmt::format("{:.4g} x {:.4g} deg, {:.4g} deg2", fieldDeg(display, display.resolutionPx.x),
                   fieldDeg(display, display.resolutionPx.y),
                   display.areaDeg2(glm::dvec2(display.resolutionPx))));
  line("one degree is level", readable(std::log2(display.pixelsPerDegree())));
  line("black and white level", fmt::format("{} and {} cd/m2", readable(display.blackLevelCdM2()),
                                            readable(display.whiteLevelCdM2())));
  if (!options.velocity.empty()) {
    const double screen = out["motion"]["screen_deg_s"];
    line("screen velocity", readable(screen) + " deg/s");
    for (const Eye& eye : kEyes)
      line((std::string("on the retina, ") + eye.name).c_str(),
           readable(retinalVelocityDegS(screen, eye.model)) + " deg/s");
  }
  line("hash", display.hash());
}

}  // namespace

void addDisplayCommand(CLI::App& app) {
  const auto options = std::make_shared<DisplayOptions>();
  CLI::App* command = app.add_subcommand("display", "Display profiles and what follows from them.");
  command->add_option("DISPLAY", options->display, "preset or file (YAML); none: a list of presets");
  command->add_flag("--list", options->list, "lists the presets");
  command->add_option("--at", options->at, "pixels per degree at this many pixels off the centre")
      ->type_name("PX");
  command
      ->add_option("--velocity", options->velocity,
                   "what a motion of this many pixels per frame is to the eye")
      ->type_name("PX");
  command->add_flag("--yaml", options->yaml, "prints the profile as a file to start from");
  command->add_flag("--json", options->json, "prints one JSON object");
  command->allow_extras();
  command->callback([options, command] {
    refuseExtras(*command);
    runDisplay(*options);
  });
}

}  // namespace limen::perception
