// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/base/enum_names.h"

/// The four mechanisms of castleCSF (Ashraf, Mantiuk, Chapiro and Wuerger 2024, doi 10.1167/jov.24.4.5). Each
/// has an absolute sensitivity, the reciprocal of the contrast at threshold, which is the product of
/// a response to temporal frequency and a sensitivity to the spatial pattern. Achromatic stimuli are detected
/// by the sum of the first two.
///
/// Contrasts are those of DKL space adapted to D65 (dklFromXyz() in colour.h): the change of A, RG or YV over
/// the background's A.
namespace limen::perception {

enum class CastleMechanism { Sustained, Transient, RedGreen, YellowViolet };
constexpr EnumNames<CastleMechanism, 4> enumNames(CastleMechanism) {
  return {{{{CastleMechanism::Sustained, "sustained"},
            {CastleMechanism::Transient, "transient"},
            {CastleMechanism::RedGreen, "red_green"},
            {CastleMechanism::YellowViolet, "yellow_violet"}}}};
}

/// Sensitivity to a foveal Gabor patch of `areaDeg2` = pi sigma^2 and spatial frequency rho [cpd] on
/// `luminanceCdM2`, where castleTemporal() is 1. 0 for a frequency or area that is not positive, and for
/// NaN; luminance is held to [1e-3, 1e4].
double castleSpatial(CastleMechanism mechanism, double rho, double luminanceCdM2, double areaDeg2);

/// Response to temporal frequency [Hz], in [0, 1]. All but Transient are low-pass: 1 at 0 Hz. Transient is
/// band-pass around castleTransientHz(). 0 for NaN.
double castleTemporal(CastleMechanism mechanism, double omegaHz, double luminanceCdM2);
/// Temporal frequency that the transient mechanism responds to best: 4.7 Hz at 1 cd/m2, 9.5 Hz at 100.
double castleTransientHz(double luminanceCdM2);
/// Luminance up to which castleTransientHz() is 0 [cd/m2]. Above it castleTemporal() of the transient
/// mechanism changes with the distance's kCastleKinkExponent-th power: at once, in practice.
double castleKinkCdM2();
inline constexpr double kCastleKinkExponent = 0.1898;

/// Product of both, with the loss at `eccentricityDeg` in the nasal field.
double csfCastle(CastleMechanism mechanism, double rho, double omegaHz, double luminanceCdM2, double areaDeg2,
                 double eccentricityDeg = 0.0);
/// Sustained plus transient: castlecsf of CsfRegistry.
double csfCastleAchromatic(double rho, double omegaHz, double luminanceCdM2, double areaDeg2,
                           double eccentricityDeg = 0.0);

}  // namespace limen::perception
