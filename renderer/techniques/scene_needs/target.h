// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <variant>

#include "experiments/base/settings_table.h"
#include "perception/threshold_maps/viewing.h"

/// What is good enough.
namespace limen::techniques {

struct RmseTarget {
  static constexpr const char *kKind = "rmse", *kSummary = "root mean square of the product's error";
  double value = 0.02;
  static const SettingsTable<RmseTarget>& table();
};

/// Figures of the metric `jnd`, by its own names.
enum class JndFigure { Median, P95, Largest };
constexpr EnumNames<JndFigure, 3> enumNames(JndFigure) {
  return {{{{JndFigure::Median, "median"}, {JndFigure::P95, "p95"}, {JndFigure::Largest, "largest"}}}};
}

struct JndTarget {
  static constexpr const char *kKind = "jnd", *kSummary = "visible difference on a display";
  double value = 1.0;
  JndFigure figure = JndFigure::P95;
  perception::ViewingSettings viewing{{"desktop_24", {}}};
  static const SettingsTable<JndTarget>& table();
};

using NeedsTarget = std::variant<RmseTarget, JndTarget>;

/// The largest error that is good enough, in its unit.
inline double largestOf(const NeedsTarget& target) {
  return std::visit([](const auto& one) { return one.value; }, target);
}
inline bool isJnd(const NeedsTarget& target) { return std::holds_alternative<JndTarget>(target); }
/// "RMSE", "p95 of JND on desktop_24".
std::string measureOf(const NeedsTarget& target);

}  // namespace limen::techniques
