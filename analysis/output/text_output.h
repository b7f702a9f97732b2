// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/statistics/interval.h"

namespace limen::analysis {

/// For HTML text and quoted attributes alike.
std::string escapeHtml(const std::string& text);
/// Escaped, with places where a long name may be broken (after / and _).
std::string breakable(const std::string& name);
/// Four significant digits, whole numbers below ten million in full.
std::string formatNumber(double value);
std::string base64(const std::string& bytes);
std::string readFileBytes(const std::string& path);                      ///< throws Error
void writeFileBytes(const std::string& path, const std::string& bytes);  ///< throws Error
/// One line of CSV (RFC 4180), ended with a line feed.
std::string csvLine(const std::vector<std::string>& fields);
/// A finite number with a decimal point, whatever the locale; none for any other text.
std::optional<double> finiteNumber(const std::string& text);
/// Place of a name in a list, to which it is added if it is new.
size_t indexIn(std::vector<std::string>& names, const std::string& name);
/// Number and noun: "1 run", "3 runs".
std::string counted(size_t count, const std::string& noun);
/// Replaces every `from` in `text`.
void replaceAll(std::string& text, const std::string& from, const std::string& to);
/// "Speed & <quality>" -> "speed_quality": safe as a file name.
std::string slug(const std::string& text);

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
