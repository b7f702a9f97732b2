// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "perception/command/settings_text.h"
#include "perception/vision/display.h"

namespace limen::perception {

/// Options that all commands on images share.
struct ImageOptions {
  std::string displayName = "schwarz_2009";
  std::vector<std::string> set, failAbove, failBelow;
  bool coded = false, linear = false, sceneLuminance = false;
  std::string alpha = "over_black";
  bool json = false, list = false;

  /// Values of inputParameters(). Throws Error if options contradict.
  ParameterValues input() const;
};

/// Adds them. `settings`: what --set takes with this display, for help and --list.
void addImageOptions(CLI::App& command, ImageOptions& options);
/// Help ends with the settings as they are declared.
void addSettingsHelp(CLI::App& command, const std::function<std::vector<SettingsGroup>()>& settings);
/// Prints the output of --list.
void printSettings(const ImageOptions& options, const std::vector<SettingsGroup>& groups);

}  // namespace limen::perception
