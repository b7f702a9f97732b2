// SPDX-License-Identifier: BSD-3-Clause
#include "perception/metrics/color_video_vdp/display.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace limen::perception::cvvdp {
namespace {

// The authors' digits: CIE 2006 cones of XYZ, and opponent channels of cones with D65 as white. Rows.
constexpr double kLmsOfXyz[3][3] = {{0.187596268556126, 0.585168649077728, -0.026384263306304},
                                    {-0.133397430663221, 0.405505777260049, 0.034502127690364},
                                    {0.000244379021663, -0.000542995890619, 0.019406849066323}};
constexpr double kDklOfLms[3][3] = {
    {1.0, 1.0, 0.0}, {1.0, -2.311130179947035, 0.0}, {-1.0, -1.0, 50.977571328718781}};

/// glm's matrices are made of columns.
glm::dmat3 fromRows(const double (&rows)[3][3]) {
  glm::dmat3 out;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) out[column][row] = rows[row][column];
  return out;
}

double decodeSrgb(double v) { return v > 0.04045 ? std::pow((v + 0.055) / 1.055, 2.4) : v / 12.92; }

/// SMPTE ST 2084, cd/m2.
double decodePq(double v) {
  constexpr double kN = 0.1593017578125, kM = 78.84375, kC1 = 0.8359375, kC2 = 18.8515625, kC3 = 18.6875;
  const double u = std::pow(v, 1.0 / kM);
  return 10000.0 * std::pow(std::max(u - kC1, 0.0) / (kC2 - kC3 * u), 1.0 / kN);
}

/// ITU-R BT.2100, light relative to the peak.
glm::dvec3 decodeHlg(const glm::dvec3& v, double gamma) {
  const double a = 0.17883277, b = 1.0 - 4.0 * a, c = 0.5 - a * std::log(4.0 * a);
  glm::dvec3 scene;
  for (int i = 0; i < 3; ++i) scene[i] = v[i] <= 0.5 ? v[i] * v[i] / 3.0 : (std::exp((v[i] - c) / a) + b) / 12.0;
  const double luminance = 0.2627 * scene.r + 0.6780 * scene.g + 0.0593 * scene.b;
  return std::pow(luminance, gamma - 1.0) * scene;
}

/// NaN counts as the lower limit.
double clampTo(double value, double least, double most) { return value > least ? std::min(value, most) : least; }

}  // namespace

glm::dmat3 ColourSpace::dklOfRgb() const { return fromRows(kDklOfLms) * fromRows(kLmsOfXyz) * xyzOfRgb; }

double Display::reflectedCdM2() const { return reflectivity * ambientLux / std::numbers::pi; }

double Display::hlgGamma() const {
  // The correction for the room is BBC White Paper 369's.
  return peakCdM2 > 1000.0 ? 1.2 + 0.42 * std::log10(peakCdM2 / 1000.0) - 0.07623 * std::log10(ambientLux / 5.0)
                           : 1.2;
}

glm::dvec3 Display::light(const glm::dvec3& value) const {
  const double reflected = reflectedCdM2();
  glm::dvec3 out, coded;
  for (int i = 0; i < 3; ++i) coded[i] = clampTo(value[i], 0.0, 1.0);
  if (colours.eotf == Eotf::Hlg) coded = decodeHlg(coded, hlgGamma());
  for (int i = 0; i < 3; ++i) {
    switch (colours.eotf) {
      case Eotf::Pq:
        // The authors add the black level although 0.005 cd/m2 is the least light already.
        out[i] = clampTo(exposure * decodePq(coded[i]), 0.005, peakCdM2) + blackCdM2 + reflected;
        continue;
      case Eotf::Linear:
        out[i] = clampTo(exposure * value[i], std::max(0.005, blackCdM2), peakCdM2) + reflected;
        continue;
      case Eotf::Srgb:
        coded[i] = decodeSrgb(coded[i]);
        break;
      case Eotf::Power:
        coded[i] = std::pow(coded[i], colours.exponent);
        break;
      case Eotf::Hlg:
        break;
    }
    // Without exposure the authors do not clip HLG's light, which may exceed the peak by a rounding.
    const double relative = exposure == 1.0 ? coded[i] : clampTo(exposure * coded[i], 0.0, 1.0);
    out[i] = (peakCdM2 - blackCdM2) * relative + blackCdM2 + reflected;
  }
  return out;
}

glm::dvec3 Display::lightOfRelative(const glm::dvec3& relative) const {
  const double floor = blackCdM2 + reflectedCdM2();
  glm::dvec3 out;
  for (int i = 0; i < 3; ++i)
    out[i] = (peakCdM2 - blackCdM2) * clampTo(exposure * relative[i], 0.0, 1.0) + floor;
  return out;
}

bool Display::showsRelativeLight() const {
  // Rec. 709's primaries and D65; the published table has them under several names.
  constexpr double kRows[3][3] = {{0.4124564, 0.3575761, 0.1804375},
                                  {0.2126729, 0.7151522, 0.0721750},
                                  {0.0193339, 0.1191920, 0.9503041}};
  return colours.xyzOfRgb == fromRows(kRows);
}

std::string Display::line() const {
  return fmt::format("{} ({}, {:.6g} to {:.6g} cd/m2, {:.4g} lux, {:.6g} pixels per degree{})", name,
                     colours.name, blackCdM2, peakCdM2, ambientLux, pixelsPerDegree,
                     exposure == 1.0 ? "" : fmt::format(", exposure {:g}", exposure));
}

Display displayOf(const DisplayProfile& profile) {
  Display out;
  out.name = profile.name;
  out.peakCdM2 = profile.peakCdM2;
  out.blackCdM2 = profile.blackCdM2;
  out.ambientLux = profile.ambientLux;
  out.reflectivity = profile.screenReflectance;
  out.pixelsPerDegree =
      1.0 / (2.0 * std::atan(0.5 * profile.pitchM() / profile.distanceM) * 180.0 / std::numbers::pi);
  out.colours = readDisplay("standard_4k").colours;
  if (profile.transfer == TransferCurve::Gamma) {
    out.colours.eotf = Eotf::Power;
    out.colours.exponent = profile.gamma;
    out.colours.name = fmt::format("sRGB primaries, gamma {:g}", profile.gamma);
  }
  return out;
}

}  // namespace limen::perception::cvvdp
