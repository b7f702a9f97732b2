// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

namespace limen::perception {

/// CIELAB for the white of sRGB (D65, 2 degrees): L* 0..100.
struct Lab {
  double lightness = 0.0, a = 0.0, b = 0.0;
};

/// IEC 61966-2-1 transfer curve. Argument and result in [0, 1].
double encodeSrgb(double linear);
/// Rec. 709 luminance of linear RGB, relative to white.
double relativeLuminance(const std::array<double, 3>& linearRgb);
Lab labFromLinearRgb(const std::array<double, 3>& linearRgb);

/// CIE94 colour difference for graphic arts (kL = 1, K1 = 0.045, K2 = 0.015). Not symmetric: chroma is
/// weighed by the reference's. Source: CIE 116-1995.
double differenceCie94(const Lab& reference, const Lab& test);

}  // namespace limen::perception
