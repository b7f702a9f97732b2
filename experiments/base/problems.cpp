// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/problems.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/base/error.h"

namespace limen {

void Problems::add(Mark mark, const std::string& what, const std::string& hint) {
  std::string text = Error(what, location(file_, mark), hint).what();
  if (said_.insert(text).second) lines_.push_back({mark, std::move(text)});
}

void Problems::throwIfAny() const {
  if (lines_.empty()) return;
  constexpr size_t kShown = 20;
  std::vector<Line> sorted = lines_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Line& a, const Line& b) {
    return a.mark.line != b.mark.line ? a.mark.line < b.mark.line : a.mark.column < b.mark.column;
  });
  std::string text;
  for (size_t i = 0; i < std::min(kShown, sorted.size()); ++i) text += (i == 0 ? "" : "\n") + sorted[i].text;
  if (sorted.size() > kShown) text += fmt::format("\n{}: {} more errors", file_, sorted.size() - kShown);
  throw Error(text);
}

}  // namespace limen
