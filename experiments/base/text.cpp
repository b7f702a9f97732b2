// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

namespace limen {
namespace {

size_t editDistance(const std::string& a, const std::string& b) {
  // Optimal string alignment: a swap of neighbours counts once, being the most common typo.
  std::vector<std::vector<size_t>> cost(a.size() + 1, std::vector<size_t>(b.size() + 1));
  for (size_t i = 0; i <= a.size(); ++i) cost[i][0] = i;
  for (size_t j = 0; j <= b.size(); ++j) cost[0][j] = j;
  for (size_t i = 1; i <= a.size(); ++i)
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t substitute = cost[i - 1][j - 1] + (a[i - 1] != b[j - 1]);
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, substitute});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
    }
  return cost[a.size()][b.size()];
}

}  // namespace

std::string nearestName(const std::string& name, const std::vector<std::string>& candidates) {
  // Comparing hundreds of kilobytes of junk with every name would take quadratic time for nothing.
  if (name.size() > 100) return {};
  std::string best;
  size_t bestDistance = std::max<size_t>(2, name.size() / 2) + 1;
  for (const std::string& candidate : candidates) {
    // "bitmask" for "soft_shadows/bitmask": the last part alone also counts as close.
    const size_t slash = candidate.rfind('/');
    size_t distance = editDistance(name, candidate);
    if (slash != std::string::npos)
      distance = std::min(distance, editDistance(name, candidate.substr(slash + 1)) + 1);
    if (distance < bestDistance) {
      bestDistance = distance;
      best = candidate;
    }
  }
  return best;
}

std::string join(const std::vector<std::string>& parts, const std::string& separator) {
  std::string out;
  for (const std::string& part : parts) out += (out.empty() ? "" : separator) + part;
  return out;
}

std::string suggest(const std::string& name, const std::vector<std::string>& candidates) {
  constexpr size_t kShown = 12;
  std::vector<std::string> shown(candidates.begin(),
                                 candidates.begin() + static_cast<long>(std::min(kShown, candidates.size())));
  std::string list = join(shown);
  if (candidates.size() > kShown) list += ", ... (" + std::to_string(candidates.size()) + " in all)";
  const std::string nearest = nearestName(name, candidates);
  return (nearest.empty() ? "" : "did you mean '" + nearest + "'? ") + "known: " + list;
}

std::string wordsOf(const std::string& name, const std::string& unit) {
  std::string suffix = unit.empty() ? "" : "_" + unit;
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char c) { return c == '/' ? '_' : static_cast<char>(std::tolower(c)); });
  const bool saysUnit = !suffix.empty() && name.size() > suffix.size() && name.ends_with(suffix);
  std::string words = saysUnit ? name.substr(0, name.size() - suffix.size()) : name;
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

std::string titleFromName(const std::string& name, const std::string& unit) {
  std::string title = wordsOf(name, unit);
  if (!title.empty()) title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
  return title;
}

std::string titleWithUnit(const std::string& title, const std::string& unit) {
  return unit.empty() ? title : title + " (" + unit + ")";
}

std::string shortestNumber(double value) {
  char buffer[40];
  // 100000, not 1e+05.
  const bool whole = std::fabs(value) < 1e15 && value == std::trunc(value);
  const auto result = whole ? std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed)
                            : std::to_chars(buffer, buffer + sizeof buffer, value);
  return {buffer, result.ptr};
}

}  // namespace limen
