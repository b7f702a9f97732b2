// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

/// The equations of contrast sensitivity as published, one function each; frequencies rho in cpd, retinal
/// velocities v in deg/s, luminances l in cd/m2. Written in forms that neither overflow nor cancel. Source:
/// Schwarz 2009, section 9.1.1 (equation numbers beside each), which cites the papers.
///
/// Every result is finite and >= 0. NaN in any argument gives 0. Luminances are clamped to [1e-4, 1e8] except
/// for Martin 1992; frequencies below 0 count as 0, velocities by their magnitude; areas, sizes and distances
/// that are not positive give 0.
namespace limen::perception {

/// Constants of (9.1): a, b and c as there.
struct Barten89Constants {
  double a = 440.0, b = 0.3, c = 0.06;
};
inline constexpr double kBarten89SizeGain = 540.0;
/// Constants of (9.2) in the order given there.
struct Barten03Constants {
  double gain = 5200.0;
  double optics = 0.0016;           ///< blur of the eye [deg2]
  double area = 144.0;              ///< largest area that is integrated over [deg2]
  double cycles = 0.64;             ///< limit on the number of cycles
  double photonNoise = 63.0;        ///< relative to neural noise, at 1 cd/m2
  double photonExponent = 0.83;     ///< of the luminance
  double lateralInhibition = 0.02;  ///< [deg2]
};
/// Coefficients of S(f, l): [power of l][power of f], with the signs of the sums in them.
using MartinCoefficients = std::array<std::array<double, 3>, 4>;
inline constexpr MartinCoefficients kMartin92Luminance = {{{2.094, 0.6019, -0.9730},
                                                           {0.2218, 0.6828, -0.3656},
                                                           {-0.10258, 0.07854, -0.05234},
                                                           {-0.01557, -0.02197, 0.03920}}};
/// a, b, c, d of lg S(f, l, a, b, c, d).
struct MartinChromaticConstants {
  double a, b, c, d;
};
inline constexpr MartinChromaticConstants kMartin92RedGreen = {-0.58800, 2.1406, 0.9153, -0.2664};
inline constexpr MartinChromaticConstants kMartin92BlueYellow = {-0.16111, 1.9395, 0.8347, -0.2728};
struct Daly93Constants {
  double peak = 250.0;      ///< P
  double epsilon = 0.9;     ///< frequency scale of the luminance CSF
  double eccentric = 0.24;  ///< loss with eccentricity [1/deg]
  double oblique = 0.78;    ///< sensitivity's frequency scale at 45 degrees
};
/// Constants of (9.3): height k1, how it changes with velocity k2, band k3 [deg/s cpd].
struct Kelly79Constants {
  double k1 = 6.1, k2 = 7.3, k3 = 45.9;
};

double csfBarten89(double rho, double l, const Barten89Constants& constants = {});  ///< (9.1)
/// (9.1), footnote; of `constants` b and c are used and `gain` instead of a.
double csfBarten89Size(double rho, double l, double widthDeg, double gain = kBarten89SizeGain,
                       const Barten89Constants& constants = {});
double csfBarten03(double rho, double l, double areaDeg2,
                   const Barten03Constants& constants = {});  ///< (9.2)
/// As printed, not clamped: a cubic in lg l, which diverges outside [0.5, 60] cpd and [1e-3, 1e3] cd/m2. 0
/// where rho or l is not positive; at most 1e300.
double csfMartin92Luminance(double rho, double l, const MartinCoefficients& s = kMartin92Luminance);
double csfMartin92RedGreen(double rho, double l);
double csfMartin92BlueYellow(double rho, double l);
double csfMartin92Chromatic(double rho, double l, const MartinChromaticConstants& constants);
double csfDaly93(double rho, double orientationDeg, double l, double imageAreaDeg2, double distanceM,
                 double eccentricityDeg, const Daly93Constants& constants = {});  ///< reconstructed
/// (9.3). 0 at v = 0: a stabilised image vanishes.
double csfKelly79(double rho, double v, const Kelly79Constants& constants = {});
/// (9.4), which is c0 csfKelly79(c1 rho, c2 v).
double csfDaly98(double rho, double v, double c0 = 1.14, double c1 = 0.67, double c2 = 1.7);
/// Excitation and inhibition of Burbeck and Kelly 1980; csf = E - I, chromatic csf of Kelly 1983 = (E + I)
/// / 30.
double burbeckKellyExcitation(double rho, double v);
double burbeckKellyInhibition(double rho, double v);
/// Their spatial (rho in cpd) and temporal (omega = rho v in Hz) parts.
double burbeckKellySpatialExcitation(double rho);
double burbeckKellySpatialInhibition(double rho);
double burbeckKellyTemporalExcitation(double omega);
double burbeckKellyTemporalInhibition(double omega);
/// 0 where inhibition exceeds excitation.
double csfBurbeckKelly80(double rho, double v);
double csfKelly83(double rho, double v);  ///< (9.5)

/// Closed-form peak of (9.4) over frequency.
double daly98PeakFrequencyCpd(double v, double c1 = 0.67, double c2 = 1.7);
double daly98PeakSensitivity(double v, double c0 = 1.14, double c1 = 0.67, double c2 = 1.7);

}  // namespace limen::perception
