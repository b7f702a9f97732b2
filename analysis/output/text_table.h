// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/statistics/interval.h"

namespace limen::analysis {

/// Characters, not bytes: codes and levels may hold letters of other alphabets.
size_t textWidth(const std::string& text);
/// Lines of text with columns of even width; the first is the heading. Columns listed in `left` are flush
/// left, the others right. Trailing blanks are cut.
std::string alignedText(const std::vector<std::vector<std::string>>& rows, const std::vector<size_t>& left,
                        const std::string& indent = "  ");

std::string percentText(double share);  ///< "67.7 %"
/// "0.100 to 0.300"; "-" for none, and for one of no width, which comes of data without spread and is no
/// certainty.
std::string intervalText(const std::optional<Interval>& interval, bool percent = false);
std::string fixedText(const std::optional<double>& value, int digits = 3);  ///< "-" for none
/// "0.012", "< 0.0001"; "-" for none.
std::string pText(const std::optional<double>& p);

}  // namespace limen::analysis
