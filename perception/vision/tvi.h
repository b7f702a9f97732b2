// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "perception/vision/csf.h"

namespace limen::perception {

/// Just visible increment [cd/m2] on an adaptation luminance [cd/m2], Ward's piecewise fit (Schwarz 2009,
/// (9.6)), with its two downward steps. L <= 0 and NaN count as 1e-6.
double tviWard(double luminanceCdM2);
/// The same without the steps: each branch is shifted to meet the next one, from 100 cd/m2 outward.
double tviWardSmoothed(double luminanceCdM2);
/// L / max over rho of csf(rho, L), other arguments as in `point`.
double tviFromCsf(const Csf& csf, CsfPoint point);
inline double cvi(double tviCdM2, double luminanceCdM2) { return tviCdM2 / luminanceCdM2; }

/// Models by name: "ward", "ward_smoothed", "from_csf" (scaled to Ward at 100 cd/m2 or not).
std::vector<std::string> tviNames();

}  // namespace limen::perception
