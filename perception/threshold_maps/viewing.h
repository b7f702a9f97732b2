// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "experiments/base/parameter.h"
#include "perception/vision/display.h"

namespace limen::perception {

/// Parameters `display` (a preset), `display_file` (a profile; takes precedence) and `distance_m` (0: the
/// profile's), for whatever needs to know how a picture is seen.
std::vector<Parameter> viewingParameters();
/// Throws Error on an unreadable profile.
DisplayProfile viewingDisplay(const ParameterValues& values);

}  // namespace limen::perception
