// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/quality/quality_counters.h"

#include <cmath>

namespace limen::techniques {

std::vector<Counter> qualityCounters(const PixelCounts& counted, const Image* budgets, int64_t budget) {
  double processed = 0.0, sum = 0.0, squares = 0.0, limited = 0.0, ofBudget = 0.0, budgetSum = 0.0;
  for (size_t i = 0; i < counted.work.size(); i += 4) {
    if (counted.work[i] != Processed) continue;
    const double examined = counted.search[i + 1];
    processed += 1.0;
    sum += examined;
    squares += examined * examined;
    const double allowed = budgets ? budgets->data[i / 4] : static_cast<double>(budget);
    if (allowed <= 0.0) continue;
    limited += 1.0;
    ofBudget += examined / allowed;
    budgetSum += allowed;
  }
  const double mean = processed > 0.0 ? sum / processed : 0.0;
  const double variance = processed > 0.0 ? squares / processed - mean * mean : 0.0;
  return {{"examined_per_px", mean},
          {"examined_sd", std::sqrt(std::max(variance, 0.0))},
          {"examined_per_budget", limited > 0.0 ? ofBudget / limited : 0.0},
          {"budget_per_px", limited > 0.0 ? budgetSum / limited : 0.0}};
}

std::vector<Quantity> qualityQuantities() {
  constexpr const char* kSource = "Schwarz 2009, table 5.1";
  return {
      {"examined_per_px", "Micro-occluders examined per pixel", "1/px", Direction::LowerIsBetter, kSource},
      {"examined_sd", "Standard deviation of micro-occluders examined", "1/px", Direction::Neither, kSource},
      {"examined_per_budget", "Micro-occluders examined per budget", "", Direction::Neither, kSource},
      {"budget_per_px", "Budget per pixel", "1/px", Direction::Neither}};
}

}  // namespace limen::techniques
