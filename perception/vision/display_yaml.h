// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "perception/vision/display.h"

namespace limen::perception {

/// The profile written by toYaml(), as stored in a result store. Throws Error like readDisplay() for a file,
/// with `where` in place of its path.
DisplayProfile displayFromYaml(const std::string& text, const std::string& where);

}  // namespace limen::perception
