// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// The equations of contrast sensitivity as published, one function each; frequencies rho in cpd, retinal
/// velocities v in deg/s, luminances l in cd/m2. Written in forms that neither overflow nor cancel. Source:
/// Schwarz 2009, section 9.1.1 (equation numbers beside each), which cites the papers.
namespace limen::perception {

double csfBarten89(double rho, double l);                       ///< (9.1)
double csfBarten89Size(double rho, double l, double widthDeg);  ///< (9.1), footnote
double csfBarten03(double rho, double l, double areaDeg2);      ///< (9.2)
double csfMartin92Luminance(double rho, double l);              ///< as printed, not clamped
double csfMartin92RedGreen(double rho, double l);
double csfMartin92BlueYellow(double rho, double l);
double csfDaly93(double rho, double orientationDeg, double l, double imageAreaDeg2, double distanceM,
                 double eccentricityDeg);  ///< reconstructed
double csfKelly79(double rho, double v);   ///< (9.3)
double csfDaly98(double rho, double v, double c0 = 1.14, double c1 = 0.67, double c2 = 1.7);  ///< (9.4)
/// Excitation and inhibition of Burbeck and Kelly 1980; csf = E - I, chromatic csf of Kelly 1983 = (E + I)
/// / 30.
double burbeckKellyExcitation(double rho, double v);
double burbeckKellyInhibition(double rho, double v);
double csfBurbeckKelly80(double rho, double v);
double csfKelly83(double rho, double v);  ///< (9.5)

/// Closed-form peak of (9.4) over frequency.
double daly98PeakFrequencyCpd(double v, double c1 = 0.67, double c2 = 1.7);
double daly98PeakSensitivity(double v, double c0 = 1.14, double c1 = 0.67, double c2 = 1.7);

}  // namespace limen::perception
