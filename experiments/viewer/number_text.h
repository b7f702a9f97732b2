// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace limen::viewer {

/// Two to four significant digits, enough to compare by eye: "0.1235", "0.50", "1.235e+06". Whole numbers
/// below ten thousand as they are; "" for NaN.
std::string numberText(double value);

/// "512 B", "1.50 kB", "3.46 GB": SI prefixes, three digits.
std::string bytesText(int64_t bytes);

}  // namespace limen::viewer
