// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/base/parameter.h"

namespace limen::perception {

/// Parameters of one part of a command. A part with a name is set as NAME.PARAMETER.
struct SettingsGroup {
  std::string name;  ///< "" for the command's own model
  std::vector<Parameter> parameters;
};

/// Values of each group (same order) from "name=value" texts. Throws Error at `where` (the option): no '=',
/// an unknown name with the nearest known one, a name given twice, a bad value.
std::vector<ParameterValues> parseSettings(const std::vector<std::string>& texts,
                                           const std::vector<SettingsGroup>& groups,
                                           const std::string& where);

/// Names, ranges, defaults, descriptions and sources, as --list prints them.
std::string listSettings(const std::vector<SettingsGroup>& groups);
nlohmann::json settingsAsJson(const std::vector<SettingsGroup>& groups);
/// One object: those of the unnamed group at the top level, every other group under its name.
nlohmann::json valuesAsJson(const std::vector<SettingsGroup>& groups,
                            const std::vector<ParameterValues>& values);

/// "name 0.5, other true": whatever differs from its default; "" if nothing does.
std::string changedSettings(const std::vector<SettingsGroup>& groups,
                            const std::vector<ParameterValues>& values);

}  // namespace limen::perception
