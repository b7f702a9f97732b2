// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>
#include <string>
#include <vector>

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
/// Number and noun: "1 run", "3 runs".
std::string counted(size_t count, const std::string& noun);
/// Replaces every `from` in `text`.
void replaceAll(std::string& text, const std::string& from, const std::string& to);
/// "Speed & <quality>" -> "speed_quality": safe as a file name.
std::string slug(const std::string& text);

}  // namespace limen::analysis
