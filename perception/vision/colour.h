// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <glm/glm.hpp>

namespace limen::perception {

/// CIELAB for the white of sRGB (D65, 2 degrees): L* 0..100.
struct Lab {
  double lightness = 0.0, a = 0.0, b = 0.0;
};

/// IEC 61966-2-1 transfer curve. Argument and result in [0, 1].
double encodeSrgb(double linear);
double decodeSrgb(double value);
/// Rec. 709 luminance of linear RGB, relative to white.
double relativeLuminance(const std::array<double, 3>& linearRgb);
/// CIE XYZ (D65, Y of white = 1) of linear Rec. 709 RGB.
glm::dvec3 xyzFromLinearRgb(const std::array<double, 3>& linearRgb);
/// White of sRGB: (0.95047, 1, 1.08883).
glm::dvec3 whiteXyz();
Lab labFromLinearRgb(const std::array<double, 3>& linearRgb);
/// Hunt-Pointer-Estevez cone responses of XYZ, normalised so that D65 of Y = 1 gives (1, 1, 1). Schwarz 2009,
/// section 10.3.
glm::dvec3 lmsFromXyz(const glm::dvec3& xyz);
/// Hunt's opponent axes: A = 2L + M + S/20, a = L - 12M/11 + S/11, b = (L + M - 2S)/9.
glm::dvec3 opponentFromLms(const glm::dvec3& lms);

/// Responses of the opponent mechanisms of DKL space adapted to D65, in the unit of `xyz`: A = L + M, RG = L
/// - (L_w / M_w) M, YV = ((L_w + M_w) / S_w) S - L - M of the cones of CIE 2006, scaled so that greys have A
/// = Y; RG = YV = 0 for them. castleCSF states the two ratios as 2.3112 and 50.9875, which differ from these
/// by 0.5 % and 1 %: those of another D65. Source: Derrington, Krauskopf and Lennie 1984; cones from XYZ as
/// in ColorVideoVDP.
glm::dvec3 dklFromXyz(const glm::dvec3& xyz);

/// CIE94 colour difference for graphic arts (kL = 1, K1 = 0.045, K2 = 0.015). Not symmetric: chroma is
/// weighted by the reference's. Source: CIE 116-1995.
double differenceCie94(const Lab& reference, const Lab& test);

}  // namespace limen::perception
