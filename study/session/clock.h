// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

namespace limen::study {

/// Seconds since 1970 of "2026-01-31T12:00:00.000Z"; nothing if the text is not an instant.
std::optional<double> utcSeconds(const std::string& utc);

}  // namespace limen::study
