// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace limen {

/// UTC now, ISO 8601 with milliseconds.
std::string utcNow();

}  // namespace limen
