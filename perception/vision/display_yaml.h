// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "perception/vision/display.h"

namespace limen::perception {

/// The profile that toYaml() wrote, as a result store keeps it. Throws Error as readDisplay() does of a file,
/// `where` standing for its path.
DisplayProfile displayFromYaml(const std::string& text, const std::string& where);

}  // namespace limen::perception
