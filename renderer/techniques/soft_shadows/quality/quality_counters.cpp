// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/quality/quality_counters.h"

#include <cmath>

namespace limen::techniques {

std::vector<Counter> qualityCounters(const VisibilityTechnique::Counted& counted, const Image* budgets,
                                     int budget) {
  double processed = 0.0, sum = 0.0, squares = 0.0, limited = 0.0, ofBudget = 0.0;
  for (size_t i = 0; i < counted.work.size(); i += 4) {
    if (counted.work[i] != Processed) continue;
    const double examined = counted.search[i + 1];
    processed += 1.0;
    sum += examined;
    squares += examined * examined;
    const double allowed = budgets ? budgets->data[i / 4] : budget;
    if (allowed <= 0.0) continue;
    limited += 1.0;
    ofBudget += examined / allowed;
  }
  const double mean = processed > 0.0 ? sum / processed : 0.0;
  const double variance = processed > 0.0 ? squares / processed - mean * mean : 0.0;
  return {{"examined_per_px", mean, "", true},
          {"examined_sd", std::sqrt(std::max(variance, 0.0)), "", false},
          {"examined_per_budget", limited > 0.0 ? ofBudget / limited : 0.0, "", false}};
}

}  // namespace limen::techniques
