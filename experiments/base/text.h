// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace limen {

/// The candidate with the smallest edit distance to `name`, or "" if none is near enough to be a plausible
/// slip.
std::string nearestName(const std::string& name, const std::vector<std::string>& candidates);

/// "a, b, c"
std::string join(const std::vector<std::string>& parts, const std::string& separator = ", ");

/// Sentence fragment for an unknown name: "did you mean 'x'? known: a, b, c" (the list is cut after 12
/// names).
std::string suggest(const std::string& name, const std::vector<std::string>& candidates);

/// "light_size" -> "light size".
std::string wordsOf(const std::string& name);
/// Title of what is declared without one: the words of its name, a capital first, without the unit that ends
/// the name ("azimuth_deg" in "deg" -> "Azimuth").
std::string titleFromName(const std::string& name, const std::string& unit);
/// "Light size (m)"; the title alone if there is no unit.
std::string titleWithUnit(const std::string& title, const std::string& unit);

/// Shortest decimal text that reads back to exactly `value`.
std::string shortestNumber(double value);

}  // namespace limen
