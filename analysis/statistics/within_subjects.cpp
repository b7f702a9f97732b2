// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/within_subjects.h"

#include <cmath>

#include "analysis/statistics/detection_rates.h"
#include "analysis/statistics/distributions.h"

namespace limen::analysis {

std::vector<std::optional<Interval>> withinSubjectIntervals(const std::vector<std::vector<double>>& values,
                                                            bool rates, double level) {
  std::vector<std::optional<Interval>> out(values.size());
  if (values.size() < 2 || values.front().size() < 2) return out;
  const size_t subjects = values.front().size();
  const auto conditions = static_cast<double>(values.size());
  std::vector<double> ofSubject(subjects);
  double grand = 0.0;
  for (const std::vector<double>& condition : values)
    for (size_t s = 0; s < subjects; ++s) ofSubject[s] += condition[s] / conditions;
  for (const double mean : ofSubject) grand += mean / static_cast<double>(subjects);
  for (size_t c = 0; c < values.size(); ++c) {
    std::vector<double> own = values[c];
    for (size_t s = 0; s < subjects; ++s) own[s] += grand - ofSubject[s];
    const MeanOverSubjects mean = meanOverSubjects(own, level);
    const double error = std::sqrt(conditions / (conditions - 1.0)) * *mean.standardError;
    const double critical = tCritical(1.0 - level, static_cast<double>(subjects) - 1.0);
    if (!rates)
      out[c] = Interval{mean.mean - critical * error, mean.mean + critical * error};
    else if (const double rate = meanOverSubjects(values[c], level).mean; rate > 0.0 && rate < 1.0)
      out[c] = logitInterval(rate, error, critical);
  }
  return out;
}

}  // namespace limen::analysis
