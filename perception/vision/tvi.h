// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "perception/vision/csf.h"

namespace limen::perception {

/// Just noticeable increment [cd/m2] at an adaptation luminance [cd/m2], Ward's piecewise fit (Schwarz 2009,
/// (9.6)), with its two downward steps. L <= 0 and NaN count as 1e-6.
double tviWard(double luminanceCdM2);
/// The same without the steps: each branch is shifted to meet the next one, starting at 100 cd/m2.
double tviWardSmoothed(double luminanceCdM2);
/// L / max over rho of csf(rho, L), other arguments as in `point`.
double tviFromCsf(const Csf& csf, CsfPoint point);
inline double cvi(double tviCdM2, double luminanceCdM2) { return tviCdM2 / luminanceCdM2; }

/// The same, scaled to match Ward's at 100 cd/m2, as in figure 9.3 of the thesis.
double tviFromCsfScaled(const Csf& csf, CsfPoint point);

/// Models by name: "ward", "ward_smoothed", "from_csf", "from_csf_scaled" (to Ward at 100 cd/m2).
std::vector<std::string> tviNames();
/// Increment [cd/m2] of adaptation luminance [cd/m2] by the named model; those from a CSF use it and the
/// other arguments of `point`, and the function keeps a reference to `csf`. Throws Error naming the nearest
/// known name.
std::function<double(double)> makeTvi(const std::string& name, std::shared_ptr<const Csf> csf,
                                      const CsfPoint& point, const std::string& where = {});

/// Weights of threshold maps: how much less sensitive the eye is at this frequency than at its best, max csf
/// / csf. At most 1e12. The original: Barten 1989 at 100 cd/m2 and 1 below 4 cpd, so as not to overestimate
/// dim regions. Ramasubramanian et al. 1999; Schwarz 2009, section 9.3.
double frequencyFactorOriginal(double frequencyCpd);
/// The same with Barten 1989 at the actual luminance, without the rule for low frequencies. Schwarz 2009,
/// section 9.4.
double frequencyFactorActual(double frequencyCpd, double luminanceCdM2);
/// For any CSF.
double frequencyFactor(const Csf& csf, const CsfPoint& point);

}  // namespace limen::perception
