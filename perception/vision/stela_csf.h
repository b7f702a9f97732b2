// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

namespace limen::perception {

/// Constants of one of the two mechanisms of stelaCSF.
struct StelaChannel {
  /// Over luminance: k1 (1 + k2/L)^-k3 (1 - (1 + k4/L)^-k5); k5 = 0: without the last factor; k2 = 0: k1
  /// L^k3.
  std::array<double, 5> gain;
  std::array<double, 3> frequency;  ///< of the peak [cpd]: k1 (1 + k2/L)^-k3
  double bandwidth = 1.0;           ///< lg 2 of the log-parabola's width
  double truncation = 0.0;          ///< below the peak it falls by no more than this share
  double area = 270.0;              ///< largest area that is integrated over [deg2]
  double cornerCpd = 0.65;          ///< frequency above which that shrinks
};

/// Constants of the achromatic part of stelaCSF or castleCSF.
struct StelaConstants {
  StelaChannel sustained, transient;
  double sustainedWidth, sustainedExponent = 1.3314;  ///< decay with temporal frequency
  double transientWidth,
      transientExponent = 0.1898;            ///< width around the transient mechanism's best frequency
  double transientHz, transientSlope = 0.0;  ///< that frequency at 1 cd/m2, and its change with lg luminance
  double drop, dropPerCpd;                   ///< lg loss with eccentricity [1/deg], [1/(deg cpd)]
};

/// Mantiuk, Ashraf and Chapiro 2022 (doi 10.1145/3528223.3530115) and the achromatic mechanism of Ashraf,
/// Mantiuk, Chapiro and Wuerger 2024 (doi 10.1167/jov.24.4.5), constants as published with them.
extern const StelaConstants kStela2022, kCastle2024;

/// Sensitivity of one mechanism to a stimulus at its best temporal frequency, in the fovea. Arguments as
/// below, finite, all but the luminance positive.
double stelaSpatial(double rho, double l, double areaDeg2, const StelaChannel& channel);

/// Sensitivity to a Gabor patch or grating: spatial frequency rho [cpd], temporal frequency omega [Hz],
/// luminance l [cd/m2], area of the patch pi sigma^2 [deg2], eccentricity [deg]. NaN in any argument and an
/// area that is not positive give 0; luminance is held to [1e-3, 1e4].
double csfStela(double rho, double omega, double l, double areaDeg2, double eccentricityDeg,
                const StelaConstants& constants);

}  // namespace limen::perception
