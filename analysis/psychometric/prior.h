// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "analysis/psychometric/fit_settings.h"

namespace limen::analysis {

/// Levels of the data on the axis, as needed for bounds and priors.
struct LevelSpread {
  double low = 0.0, high = 0.0;  ///< ends of the range; of FitSettings::range if that is set
  double spacing =
      0.0;  ///< the smallest distance between two levels of the data; the range if there are none

  double range() const { return high - low; }
};
/// Of levels `u` on the axis; infinite ones (no stimulus) do not count.
LevelSpread spreadOf(std::vector<double> u, const FitSettings& settings);

/// ln of the prior density and its derivative, those of psignifit 4 (Schuett, Harmeling, Macke and Wichmann
/// 2016, Vision Research 122, section 2.3), up to a constant:
///
///     threshold t   1 for low <= t <= high, falling as a cosine to 0 at half a range beyond either end
///     width w       c w rises as a cosine from 0 at the spacing to 1 at twice that, and falls from 1 at the
///                   range to 0 at three ranges; c = 1 because widths run from 0.05 to 0.95. If twice the
///                   spacing exceeds the range the two parts are multiplied
///     guess, lapse, eta   Beta(1, 10): (1 - p)^9
///
/// On logarithmic axes densities are those of ln x. -infinity if the prior is 0.
struct LogPrior {
  double value = 0.0, slope = 0.0;
};
LogPrior logPrior(FitParameter parameter, double value, const LevelSpread& spread);

/// The formula with its numbers, for reports: in terms of x or ln x, for either direction of F.
std::string priorText(FitParameter parameter, const LevelSpread& spread, bool falling);

}  // namespace limen::analysis
