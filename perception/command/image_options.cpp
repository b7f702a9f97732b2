// SPDX-License-Identifier: BSD-3-Clause
#include "perception/command/image_options.h"

#include <cstdio>
#include <map>

#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "perception/command/image_input.h"

namespace limen::perception {

ParameterValues ImageOptions::input() const {
  if (int{coded} + int{linear} + int{sceneLuminance} > 1)
    throw Error("--coded, --linear and --scene-luminance exclude each other", {}, "give one of them");
  std::map<std::string, ParameterValue> given = {{"alpha", alpha}};
  if (coded) given["values"] = std::string("coded");
  if (linear) given["values"] = std::string("linear");
  if (sceneLuminance) given["values"] = std::string("luminance");
  return {inputParameters(), given, "--alpha"};
}

void addImageOptions(CLI::App& command, ImageOptions& options) {
  command
      .add_option("--display", options.displayName,
                  "Display and viewer: a preset (" + join(displayPresets()) + ") or the file of a profile")
      ->type_name("NAME|FILE")
      ->capture_default_str();
  CLI::Option* const coded =
      command.add_flag("--coded", options.coded, "Files hold pixel values; default for integer files");
  CLI::Option* const linear =
      command.add_flag("--linear", options.linear,
                       "Files hold light, 1 is the display's white; default for floating-point files");
  CLI::Option* const luminance =
      command.add_flag("--scene-luminance", options.sceneLuminance,
                       "Files hold light in cd/m2, clipped to what the display shows");
  linear->excludes(coded);
  luminance->excludes(coded)->excludes(linear);
  command
      .add_option("--alpha", options.alpha, "over_black: composited over black; ignore: colours as stored")
      ->type_name("RULE")
      ->capture_default_str();
  command.add_option("--set", options.set, "A setting of the model (below; --list); may be repeated")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  command.add_flag("--list", options.list, "Print the settings with ranges, defaults and sources, and exit");
  command.add_flag("--json", options.json,
                   "JSON on standard output: an object, or one line per frame and a summary line");
}

void addSettingsHelp(CLI::App& command, const std::function<std::vector<SettingsGroup>()>& settings) {
  command.footer([settings] {
    return "Settings (--set NAME=VALUE), with their defaults:\n" + listSettings(settings());
  });
}

void printSettings(const ImageOptions& options, const std::vector<SettingsGroup>& groups) {
  if (options.json) {
    std::printf("%s\n", settingsAsJson(groups).dump().c_str());
  } else {
    std::printf("%s", listSettings(groups).c_str());
  }
}

}  // namespace limen::perception
