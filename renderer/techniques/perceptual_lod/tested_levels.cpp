// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/perceptual_lod/tested_levels.h"

#include <algorithm>
#include <cassert>

#include "experiments/base/error.h"

namespace limen::techniques {
namespace {

constexpr const char* kRuleSource = "Schwarz 2009, section 9.5 (values not given there)";

}  // namespace

std::vector<Parameter> LevelRule::parameters() {
  return {
      realParameter("delta_l", 4.0, 0.0, 1e8, "delta_unit", "Fewer visible pixels: to the next coarser level",
                    kRuleSource),
      realParameter("delta_u", 16.0, 0.0, 1e8, "delta_unit", "More visible pixels: to the next finer level",
                    kRuleSource),
      choiceParameter("delta_unit", "px", {"px", "share"},
                      "Of delta_l and delta_u: pixels, or shares (0..1) of the pixels that the object covers",
                      "Schwarz 2009, section 9.5 (px)"),
      choiceParameter(
          "coarsen", "at_once", {"at_once", "if_invisible"},
          "Below delta_l go coarser at once, or only if the next coarser level has at most delta_u "
          "visible pixels (a second rendering for each test)",
          "Schwarz 2009, section 9.5 (at_once)")};
}

LevelRule LevelRule::from(const ParameterValues& values) {
  LevelRule out;
  out.lower = values.real("delta_l");
  out.upper = values.real("delta_u");
  out.unit = values.text("delta_unit") == "share" ? Unit::Share : Unit::Px;
  out.lookAhead = values.text("coarsen") == "if_invisible";
  if (out.lower > out.upper)
    throw Error("delta_l is above delta_u: every object between them would change its level for ever",
                "delta_l", "give delta_l <= delta_u");
  return out;
}

int LevelRule::step(const LevelTest& test) const {
  if (test.coveredPx == 0) return 0;
  const double visible = measure(test.visiblePx, test.coveredPx);
  if (visible > upper) return -1;
  if (!(visible < lower)) return 0;
  return lookAhead && measure(test.nextVisiblePx, test.coveredPx) > upper ? 0 : 1;
}

TestedLevels::TestedLevels(LevelRule rule, std::vector<int> levelCounts, int startLevel)
    : rule_(rule), levelCounts_(std::move(levelCounts)), lastSteps_(levelCounts_.size(), 0) {
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

void TestedLevels::apply(const LevelTest& test) {
  ++tested_;
  const auto object = static_cast<size_t>(test.object);
  if (levels_[object] != test.level) {
    ++dropped_;
    return;
  }
  const int level = std::clamp(test.level + rule_.step(test), 0, levelCounts_[object] - 1);
  const int step = level - test.level;
  if (step == 0) return;
  ++switches_;
  if (step == -lastSteps_[object]) ++reversals_;
  lastSteps_[object] = step;
  levels_[object] = level;
}

}  // namespace limen::techniques
