// SPDX-License-Identifier: BSD-3-Clause
// Steps of a visibility image where its reference has none. If a method changes its coarseness from pixel to
// pixel, its error changes there; but it also changes wherever the occluders do, and the more the coarser the
// method is overall. So this ranks choices of levels by their cost as much as by their discontinuities; the
// effect of a level change alone is counted by the techniques that choose levels (level_step_max and others).
#include <algorithm>
#include <cmath>
#include <vector>

#include "perception/metrics/comparison.h"
#include "perception/metrics/quantile.h"

namespace limen::perception {
namespace {

struct StepSettings {
  ComparedRegion region;
  double share = 1.0;  ///< of the pairs of neighbours
  static const SettingsTable<StepSettings>& table() {
    static const SettingsTable<StepSettings> kTable = {
        included(&StepSettings::region),
        {&StepSettings::share,
         "share",
         {0.0, 1.0},
         "",
         "share of neighbour pairs whose change is at most the figure; 1: all"}};
    return kTable;
  }
};

MetricResult measureDiscontinuity(const ComparisonInput& input, const StepSettings& settings) {
  const Comparison pair(input, "discontinuity", settings.region.region);
  pair.requireVisibility("discontinuity");
  MetricResult result;
  result.evaluatedPixels = pair.evaluatedPixels();
  Image map(pair.width(), pair.height(), 1);
  std::vector<double> steps;
  const auto visit = [&](int x, int y, int neighbourX, int neighbourY) {
    if (!pair.evaluates(neighbourX, neighbourY)) return;
    const double step = std::abs(pair.error(x, y, 0) - pair.error(neighbourX, neighbourY, 0));
    steps.push_back(step);
    for (float* value : {&map.at(x, y), &map.at(neighbourX, neighbourY)})
      *value = std::max(*value, static_cast<float>(step));
  };
  for (int y = 0; y < pair.height(); ++y)
    for (int x = 0; x < pair.width(); ++x) {
      if (!pair.evaluates(x, y)) continue;
      if (x + 1 < pair.width()) visit(x, y, x + 1, y);
      if (y + 1 < pair.height()) visit(x, y, x, y + 1);
    }
  result.value = nearestRank(steps, settings.share);
  result.map = std::move(map);
  result.mapName = "discontinuity";
  return result;
}

const RegisteredMetric<StepSettings> kRegistered{
    {.name = "discontinuity",
     .summary = "change of the error from a pixel to its neighbour (level discontinuities and any other "
                "unsmoothness), the largest or one that a share of all pairs does not exceed",
     .title = "Step of the error between neighbours"},
    &measureDiscontinuity};

}  // namespace
}  // namespace limen::perception
