// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "perception/vision/csf.h"

namespace limen::perception {

/// How the constants of Daly 1998 follow the adaptation luminance: as the peak of Barten 2003 does. Schwarz
/// 2009, section 10.3. At 100 cd/m2 they are 1.14 and 0.67. Luminances are clamped to [1e-4, 1e4] cd/m2.
/// Areas that are not positive count as 1e-4 deg2. Some microseconds each.
double daly98C0(double luminanceCdM2, double areaDeg2);
double daly98C1(double luminanceCdM2, double areaDeg2);

/// Peak of Barten 2003 over frequency, to 1e-12; luminance and area are clamped as above.
Csf::Peak barten03Peak(double luminanceCdM2, double areaDeg2);

/// 5 - 3 tanh(0.4 lg L).
double pupilDiameterMm(double luminanceCdM2);
double retinalIlluminanceTd(double luminanceCdM2);
/// Factor on Kelly 1983's chromatic sensitivity: sqrt(E(L) / E(reference)).
double chromaticScale(double luminanceCdM2, double referenceCdM2 = 35.0);

}  // namespace limen::perception
