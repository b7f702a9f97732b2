// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "experiments/base/settings_table.h"

namespace limen::techniques {

/// Result of testing an object at one level.
struct LevelTest {
  int object = 0, level = 0;   ///< as they were when the test was drawn
  uint32_t coveredPx = 0;      ///< pixels where the object is seen at this level or at the finest
  uint32_t visiblePx = 0;      ///< of these, how many differ from the finest level by more than the threshold
  uint32_t nextVisiblePx = 0;  ///< the same for the next coarser level, if that was tested
  bool nextTested = true;
};

/// Limits in pixels: the thesis's, counts that grow with resolution and with the object.
struct PixelLimits {
  static constexpr const char *kKind = "px", *kSummary = "pixels";
  double lower = 4.0, upper = 16.0;  ///< delta_l and delta_u
  static const SettingsTable<PixelLimits>& table();
  /// Throws Error if the lower one is above the upper one.
  void check() const;
};

/// Limits as shares of the pixels that the object covers.
struct ShareLimits {
  static constexpr const char *kKind = "share", *kSummary = "shares of the pixels that the object covers";
  double lower = 0.01, upper = 0.04;
  static const SettingsTable<ShareLimits>& table();
  void check() const;
};

/// What happens to an object whose visible pixels are below the lower limit.
enum class Coarsen {
  AtOnce,  ///< the thesis's rule, which considers only the current level
  /// Coarser only if the next coarser level would not be reverted at once (n_vis <= upper limit). Otherwise
  /// an object oscillates between its last invisible and its first visible level unless n_vis of the latter
  /// lies between the limits.
  IfInvisible
};
constexpr EnumNames<Coarsen, 2> enumNames(Coarsen) {
  return {{{{Coarsen::AtOnce, "at_once"}, {Coarsen::IfInvisible, "if_invisible"}}}};
}

/// When a test changes a level. Source: Schwarz 2009, section 9.5, which gives no figures.
struct LevelRule {
  std::variant<PixelLimits, ShareLimits> limits;
  Coarsen coarsen = Coarsen::AtOnce;
  static const SettingsTable<LevelRule>& table();

  double lower() const;
  double upper() const;
  bool lookAhead() const { return coarsen == Coarsen::IfInvisible; }
  /// A count in the unit of the limits.
  double measure(uint32_t count, uint32_t coveredPx) const {
    if (std::holds_alternative<PixelLimits>(limits)) return count;
    return coveredPx > 0 ? double(count) / coveredPx : 0.0;
  }
  /// +1: coarser, -1: finer, 0: keep; the caller clamps. An object of which nothing is visible keeps its
  /// level, and so does one whose next level would have to be known and was not tested.
  int step(const LevelTest& test) const;
};

/// Levels of all objects, and which are next to be tested.
class TestedLevels {
 public:
  /// `levelCounts`: levels of each object, at least one.
  TestedLevels(LevelRule rule, std::vector<int> levelCounts, int startLevel);

  const std::vector<int>& levels() const { return levels_; }
  const LevelRule& rule() const { return rule_; }
  /// The next at most `count` objects in turn among those that may be tested (`testable`, one per object) and
  /// have more than one level.
  std::vector<int> nextTests(int count, const std::vector<char>& testable);
  /// Makes it this object's turn.
  void resumeWith(int object) { turn_ = static_cast<size_t>(object); }
  /// Whether a test of the object should try its next coarser level: the rule asks for it, there is one, and
  /// when the object was last tested at its level it had few enough visible pixels to go there, or was not
  /// tested yet.
  bool triesNext(int object) const;
  /// Applies a test; a test of a level that the object has since left is dropped.
  void apply(const LevelTest& test);

  int64_t tested() const { return tested_; }  ///< tests applied or dropped
  int64_t dropped() const { return dropped_; }
  int64_t switches() const { return switches_; }
  /// Switches that undid the object's previous switch: oscillation.
  int64_t reversals() const { return reversals_; }

 private:
  LevelRule rule_;
  std::vector<int> levelCounts_, levels_, lastSteps_;
  std::vector<char> stays_;  ///< by its last test at its level, the object goes no coarser
  size_t turn_ = 0;
  int64_t tested_ = 0, dropped_ = 0, switches_ = 0, reversals_ = 0;
};

}  // namespace limen::techniques
