// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/perceptual_lod/tested_levels.h"

#include <algorithm>
#include <cassert>

#include "experiments/base/error.h"

namespace limen::techniques {
namespace {

constexpr const char* kRuleSource = "Schwarz 2009, section 9.5 (values not given there)";

/// Throws Error if every object between the limits would keep changing its level forever.
void checkOrder(double lower, double upper) {
  if (lower > upper)
    throw Error(
        "the lower limit is above the upper one: every object between them would keep changing its level for "
        "ever",
        "lower", "give lower <= upper");
}

const char* const kLowerHelp = "With fewer visible pixels, switch to the next coarser level";
const char* const kUpperHelp = "With more visible pixels, switch to the next finer level";

}  // namespace

const SettingsTable<PixelLimits>& PixelLimits::table() {
  using S = PixelLimits;
  static const SettingsTable<S> kTable = {
      Binding(&S::lower, "lower", Range{0.0, 1e8}, "px", kLowerHelp, kRuleSource).formerly({"delta_l"}),
      Binding(&S::upper, "upper", Range{0.0, 1e8}, "px", kUpperHelp, kRuleSource).formerly({"delta_u"})};
  return kTable;
}

const SettingsTable<ShareLimits>& ShareLimits::table() {
  using S = ShareLimits;
  static const SettingsTable<S> kTable = {{&S::lower, "lower", {0.0, 1.0}, "", kLowerHelp, kRuleSource},
                                          {&S::upper, "upper", {0.0, 1.0}, "", kUpperHelp, kRuleSource}};
  return kTable;
}

void PixelLimits::check() const { checkOrder(lower, upper); }
void ShareLimits::check() const { checkOrder(lower, upper); }

const SettingsTable<LevelRule>& LevelRule::table() {
  using S = LevelRule;
  static const SettingsTable<S> kTable = {
      Binding(&S::limits, "limits",
              "Visible pixels that change a level, counted or as a share of the object's",
              "Schwarz 2009, section 9.5 (counted)")
          .formerly({"delta_unit"}),
      Binding(&S::coarsen, "coarsen",
              "Below the lower limit go coarser at once, or only if the next coarser level is not above the "
              "upper one (needs a second rendering per test)",
              "Schwarz 2009, section 9.5 (at_once)")
          .formerly({"coarsen"})};
  return kTable;
}

double LevelRule::lower() const {
  return std::visit([](const auto& in) { return in.lower; }, limits);
}

double LevelRule::upper() const {
  return std::visit([](const auto& in) { return in.upper; }, limits);
}

int LevelRule::step(const LevelTest& test) const {
  if (test.coveredPx == 0) return 0;
  const double visible = measure(test.visiblePx, test.coveredPx);
  if (visible > upper()) return -1;
  if (!(visible < lower())) return 0;
  if (lookAhead() && !test.nextTested) return 0;
  return lookAhead() && measure(test.nextVisiblePx, test.coveredPx) > upper() ? 0 : 1;
}

TestedLevels::TestedLevels(LevelRule rule, std::vector<int> levelCounts, int startLevel)
    : rule_(rule),
      levelCounts_(std::move(levelCounts)),
      lastSteps_(levelCounts_.size(), 0),
      stays_(levelCounts_.size(), 0) {
  for (const int count : levelCounts_) {
    assert(count >= 1);
    levels_.push_back(std::clamp(startLevel, 0, count - 1));
  }
}

std::vector<int> TestedLevels::nextTests(int count, const std::vector<char>& testable) {
  assert(testable.size() == levels_.size());
  std::vector<int> out;
  for (size_t looked = 0; looked < levels_.size() && static_cast<int>(out.size()) < count; ++looked) {
    const size_t object = turn_;
    turn_ = (turn_ + 1) % levels_.size();
    if (testable[object] && levelCounts_[object] > 1) out.push_back(static_cast<int>(object));
  }
  return out;
}

bool TestedLevels::triesNext(int object) const {
  const auto i = static_cast<size_t>(object);
  return rule_.lookAhead() && levels_[i] + 1 < levelCounts_[i] && !stays_[i];
}

void TestedLevels::apply(const LevelTest& test) {
  ++tested_;
  const auto object = static_cast<size_t>(test.object);
  if (levels_[object] != test.level) {
    ++dropped_;
    return;
  }
  stays_[object] = test.coveredPx > 0 && !(rule_.measure(test.visiblePx, test.coveredPx) < rule_.lower());
  const int level = std::clamp(test.level + rule_.step(test), 0, levelCounts_[object] - 1);
  const int step = level - test.level;
  if (step == 0) return;
  ++switches_;
  if (step == -lastSteps_[object]) ++reversals_;
  lastSteps_[object] = step;
  levels_[object] = level;
  stays_[object] = 0;
}

}  // namespace limen::techniques
