// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/detail/check.h"

#include <fmt/format.h>

#include <cmath>

#include "experiments/base/error.h"

namespace limen::analysis {

std::string indexed(const std::string& name, size_t index) { return fmt::format("{}[{}]", name, index); }

void requireLevel(double level) {
  if (level > 0.0 && level < 1.0) return;
  throw Error(fmt::format("{} is no confidence level", level), "level",
              "give one between 0 and 1, such as 0.95");
}

void requireFinite(double value, const std::string& where) {
  if (std::isfinite(value)) return;
  throw Error(fmt::format("{} is not a finite number", value), where, "leave out what was not measured");
}

void requireFinite(const std::vector<double>& values, const std::string& name) {
  for (size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i])) requireFinite(values[i], indexed(name, i));
}

void requireAtLeast(size_t length, size_t least, const std::string& name) {
  if (length >= least) return;
  throw Error(fmt::format("{} values, needs at least {}", length, least), name);
}

void requireSameLength(size_t length, const std::string& name, size_t other, const std::string& otherName) {
  if (length == other) return;
  throw Error(fmt::format("has {} values where {} has {}", length, name, other),
              indexed(otherName, length < other ? length : other), "give as many of one as of the other");
}

void requireCounts(int64_t successes, int64_t trials, const std::string& where, bool atLeastOne) {
  if (trials < 0) throw Error(fmt::format("{} trials, a count is not negative", trials), where);
  if (successes < 0) throw Error(fmt::format("a count of {}, a count is not negative", successes), where);
  if (successes > trials) throw Error(fmt::format("{} of {} trials", successes, trials), where);
  if (atLeastOne && trials == 0)
    throw Error("no trials, so there is no rate", where, "leave it out or collect answers");
}

void requireSample(const std::vector<double>& x, const std::string& nameX, const std::vector<double>& y,
                   const std::string& nameY, double level) {
  requireSameLength(x.size(), nameX, y.size(), nameY);
  requireAtLeast(x.size(), 2, nameX);
  requireFinite(x, nameX);
  requireFinite(y, nameY);
  requireLevel(level);
}

}  // namespace limen::analysis
