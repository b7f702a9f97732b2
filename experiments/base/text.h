// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace limen {

/// The candidate with the smallest edit distance to `name`, or "" if none is close enough to be a plausible
/// typo.
std::string nearestName(const std::string& name, const std::vector<std::string>& candidates);

/// "a, b, c"
std::string join(const std::vector<std::string>& parts, const std::string& separator = ", ");

/// Sentence fragment for an unknown name: "did you mean 'x'? known: a, b, c" (the list stops after 12 names).
std::string suggest(const std::string& name, const std::vector<std::string>& candidates);

/// The words of a declared name, without its unit where the name ends in that: "light_size" -> "light size",
/// "azimuth_deg" in "deg" -> "azimuth".
std::string wordsOf(const std::string& name, const std::string& unit = {});
/// The title of something declared without one: its words, capitalised.
std::string titleFromName(const std::string& name, const std::string& unit);
/// "Light size (m)"; the title alone if there is no unit.
std::string titleWithUnit(const std::string& title, const std::string& unit);

/// Shortest decimal text that reads back to exactly `value`.
std::string shortestNumber(double value);

}  // namespace limen
