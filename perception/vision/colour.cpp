// SPDX-License-Identifier: BSD-3-Clause
#include "perception/vision/colour.h"

#include <cmath>

namespace limen::perception {
namespace {

double labCurve(double t) {
  constexpr double kDelta = 6.0 / 29.0;
  return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3.0 * kDelta * kDelta) + 4.0 / 29.0;
}

}  // namespace

double encodeSrgb(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

double decodeSrgb(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

glm::dvec3 whiteXyz() { return {0.95047, 1.0, 1.08883}; }

glm::dvec3 xyzFromLinearRgb(const std::array<double, 3>& linearRgb) {
  const auto [r, g, b] = linearRgb;
  return {0.4124564 * r + 0.3575761 * g + 0.1804375 * b, 0.2126729 * r + 0.7151522 * g + 0.0721750 * b,
          0.0193339 * r + 0.1191920 * g + 0.9503041 * b};
}

glm::dvec3 lmsFromXyz(const glm::dvec3& xyz) {
  return {0.40024 * xyz.x + 0.70760 * xyz.y - 0.08081 * xyz.z,
          -0.22630 * xyz.x + 1.16532 * xyz.y + 0.04570 * xyz.z, 0.91822 * xyz.z};
}

glm::dvec3 opponentFromLms(const glm::dvec3& lms) {
  return {2.0 * lms.x + lms.y + lms.z / 20.0, lms.x - 12.0 * lms.y / 11.0 + lms.z / 11.0,
          (lms.x + lms.y - 2.0 * lms.z) / 9.0};
}

glm::dvec3 dklFromXyz(const glm::dvec3& xyz) {
  const auto cones = [](const glm::dvec3& c) {
    return glm::dvec3(0.187596268556126 * c.x + 0.585168649077728 * c.y - 0.026384263306304 * c.z,
                      -0.133397430663221 * c.x + 0.405505777260049 * c.y + 0.034502127690364 * c.z,
                      0.000244379021663 * c.x - 0.000542995890619 * c.y + 0.019406849066323 * c.z);
  };
  static const glm::dvec3 kWhite = cones(whiteXyz());
  const glm::dvec3 lms = cones(xyz) / (kWhite.x + kWhite.y);
  return {lms.x + lms.y, lms.x - kWhite.x / kWhite.y * lms.y,
          (kWhite.x + kWhite.y) / kWhite.z * lms.z - lms.x - lms.y};
}

double relativeLuminance(const std::array<double, 3>& linearRgb) {
  return 0.2126 * linearRgb[0] + 0.7152 * linearRgb[1] + 0.0722 * linearRgb[2];
}

Lab labFromLinearRgb(const std::array<double, 3>& linearRgb) {
  // XYZ over the white's XYZ. The primaries and white of sRGB are given to four decimals, which makes the
  // matrix one of fractions; each row is divided by its sum, since white is (1, 1, 1).
  const auto [r, g, b] = linearRgb;
  const double x = (10135552.0 * r + 8788810.0 * g + 4435075.0 * b) / 23359437.0;
  const double y = (2613072.0 * r + 8788810.0 * g + 887015.0 * b) / 12288897.0;
  const double z = (1425312.0 * r + 8788810.0 * g + 70074185.0 * b) / 80288307.0;
  const double fx = labCurve(x), fy = labCurve(y), fz = labCurve(z);
  return {116.0 * fy - 16.0, 500.0 * (fx - fy), 200.0 * (fy - fz)};
}

double differenceCie94(const Lab& reference, const Lab& test) {
  const double referenceChroma = std::hypot(reference.a, reference.b);
  const double lightness = reference.lightness - test.lightness;
  const double chroma = referenceChroma - std::hypot(test.a, test.b);
  const double da = reference.a - test.a, db = reference.b - test.b;
  // Rounding can make the hue's share of equal hues a little negative.
  const double hueSquared = std::fmax(0.0, da * da + db * db - chroma * chroma);
  const double chromaScale = 1.0 + 0.045 * referenceChroma, hueScale = 1.0 + 0.015 * referenceChroma;
  return std::sqrt(lightness * lightness + chroma * chroma / (chromaScale * chromaScale) +
                   hueSquared / (hueScale * hueScale));
}

}  // namespace limen::perception
