// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "analysis/psychometric/intervals.h"
#include "analysis/study/fitted_parts.h"

namespace limen::analysis {

/// Intervals of functions fitted to answers that are pooled over observers, with observers as the unit: the
/// fit is made anew without each of them (jackknife over clusters; Efron and Stein 1981, Annals of Statistics
/// 9), and the interval is estimate +- t_(n-1) error, on ln scales for threshold (on a logarithmic axis),
/// width and slope. With the few observers of a study a percentile bootstrap over them is too narrow, as it
/// lacks Student's t and n / (n - 1) (Davison and Hinkley 1997, section 2.4). None for rates that lie at a
/// bound of the fit, and of conditions with the answers of one observer.
///
/// `fit`: of `part`, which was made of `study`. Everything else of the fit, rates held at those of catch
/// trials apart, stays as it was.
FitIntervals observerIntervals(const StudyAnswers& study, const FittedPart& part, const Fit& fit,
                               double confidence);

}  // namespace limen::analysis
