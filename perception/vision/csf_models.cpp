// SPDX-License-Identifier: BSD-3-Clause
#include "perception/vision/csf_models.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace limen::perception {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kLeastLuminance = 1e-4, kLargestLuminance = 1e8;

template <class... T>
bool anyNan(T... values) {
  return (std::isnan(values) || ...);
}

double clampLuminance(double l) { return std::clamp(l, kLeastLuminance, kLargestLuminance); }

double cube(double x) { return x * x * x; }

// rho exp(-b rho) sqrt(1 + c exp(b rho)) with both exponentials under the root, where neither overflows.
double bartenBand(double rho, double b, double c) {
  if (!(rho > 0.0) || std::isinf(rho)) return 0.0;
  return rho * std::sqrt(std::exp(-2.0 * b * rho) + c * std::exp(-b * rho));
}

double bartenAdaptation(double l) { return std::pow(1.0 + 0.7 / l, -0.2); }
double bartenSlope(double l, double b) { return b * std::pow(1.0 + 100.0 / l, 0.15); }

}  // namespace

double csfBarten89(double rho, double l, const Barten89Constants& constants) {
  if (anyNan(rho, l)) return 0.0;
  l = clampLuminance(l);
  return constants.a * bartenAdaptation(l) * bartenBand(rho, bartenSlope(l, constants.b), constants.c);
}

double csfBarten89Size(double rho, double l, double widthDeg, double gain,
                       const Barten89Constants& constants) {
  if (anyNan(rho, l, widthDeg) || widthDeg <= 0.0) return 0.0;
  l = clampLuminance(l);
  rho = std::max(rho, 0.0);
  const double a =
      gain * bartenAdaptation(l) / (1.0 + 12.0 / (widthDeg * (1.0 + rho / 3.0) * (1.0 + rho / 3.0)));
  return a * bartenBand(rho, bartenSlope(l, constants.b), constants.c);
}

double csfBarten03(double rho, double l, double areaDeg2, const Barten03Constants& constants) {
  if (anyNan(rho, l, areaDeg2) || rho <= 0.0 || areaDeg2 <= 0.0) return 0.0;
  l = clampLuminance(l);
  const double square = rho * rho;
  const double optics = std::exp(-constants.optics * square * std::pow(1.0 + 100.0 / l, 0.08));
  if (optics == 0.0) return 0.0;
  // 1 - exp(-x) loses precision for small x, expm1 does not. It is 0 once rho^2 underflows.
  const double lateral = -std::expm1(-constants.lateralInhibition * square);
  if (lateral <= 0.0) return 0.0;
  const double integration = 1.0 + constants.area / areaDeg2 + constants.cycles * square;
  const double noise = constants.photonNoise / std::pow(l, constants.photonExponent) + 1.0 / lateral;
  return constants.gain * optics / std::sqrt(integration * noise);
}

double csfMartin92Luminance(double rho, double l, const MartinCoefficients& s) {
  if (!(rho > 0.0) || !(l > 0.0) || std::isinf(rho) || std::isinf(l)) return 0.0;
  const double f = std::log10(rho), lg = std::log10(l);
  double exponent = 0.0;
  for (int power = 3; power >= 0; --power) {
    const auto& row = s[static_cast<size_t>(power)];
    exponent = exponent * lg + row[0] + f * (row[1] + f * row[2]);
  }
  return std::pow(10.0, std::min(exponent, 300.0));
}

double csfMartin92Chromatic(double rho, double l, const MartinChromaticConstants& constants) {
  if (anyNan(rho, l)) return 0.0;
  const auto [a, b, c, d] = constants;
  const double lg = std::log10(clampLuminance(l));
  double exponent = a + b + (lg <= 2.3 ? 0.5 * lg : 1.15);
  // The plateau is tested in cpd, so that rho = 0 never reaches a logarithm.
  if (rho > std::pow(10.0, d)) exponent -= c * (std::log10(rho) - d) * (std::log10(rho) - d);
  return std::pow(10.0, exponent);
}

double csfMartin92RedGreen(double rho, double l) { return csfMartin92Chromatic(rho, l, kMartin92RedGreen); }
double csfMartin92BlueYellow(double rho, double l) {
  return csfMartin92Chromatic(rho, l, kMartin92BlueYellow);
}

double csfDaly93(double rho, double orientationDeg, double l, double imageAreaDeg2, double distanceM,
                 double eccentricityDeg, const Daly93Constants& constants) {
  if (anyNan(rho, orientationDeg, l, imageAreaDeg2, distanceM, eccentricityDeg)) return 0.0;
  if (rho <= 0.0 || imageAreaDeg2 <= 0.0 || distanceM <= 0.0 || std::isinf(orientationDeg)) return 0.0;
  l = clampLuminance(l);
  const double gain = 0.801 * bartenAdaptation(l), slope = bartenSlope(l, 0.3) * constants.epsilon;
  const auto band = [&](double u) {
    if (!(u > 0.0) || std::isinf(u)) return 0.0;
    const double large = std::pow(3.23, 5.0) * std::pow(u * std::sqrt(imageAreaDeg2), -3.0);
    return std::pow(large + 1.0, -0.2) * gain * constants.epsilon * bartenBand(u, slope, 0.06);
  };
  const double accommodation = 0.856 * std::pow(distanceM, 0.14);
  const double eccentricity = 1.0 / (1.0 + constants.eccentric * std::abs(eccentricityDeg));
  const double half = 0.5 * (1.0 - constants.oblique);
  const double orientation =
      half * std::cos(4.0 * std::fmod(orientationDeg, 360.0) * kPi / 180.0) + (1.0 - half);
  return constants.peak * std::min(band(rho / (accommodation * eccentricity * orientation)), band(rho));
}

double csfKelly79(double rho, double v, const Kelly79Constants& constants) {
  if (anyNan(rho, v)) return 0.0;
  v = std::abs(v);
  if (rho <= 0.0 || v == 0.0 || std::isinf(rho) || std::isinf(v)) return 0.0;
  // The root of the exponential goes into the square, so that neither factor overflows while the other is 0.
  const double root = std::exp(-2.0 * kPi * rho * (v + 2.0) / constants.k3);
  if (root == 0.0) return 0.0;
  const double alpha = 2.0 * kPi * rho * root;
  const double height = constants.k1 + constants.k2 * cube(std::abs(std::log10(v / 3.0)));
  // v alpha is bounded where the exponential is not 0, v alone is not.
  return height * (v * alpha) * alpha;
}

double csfDaly98(double rho, double v, double c0, double c1, double c2) {
  return c0 * csfKelly79(c1 * rho, c2 * v);
}

double daly98PeakFrequencyCpd(double v, double c1, double c2) {
  return 45.9 / (2.0 * kPi * c1 * (c2 * std::abs(v) + 2.0));
}

double daly98PeakSensitivity(double v, double c0, double /*c1 moves the peak, not its height*/, double c2) {
  const double speed = c2 * std::abs(v);
  if (!(speed > 0.0) || std::isinf(speed)) return 0.0;
  const double height = 6.1 + 7.3 * cube(std::abs(std::log10(speed / 3.0)));
  return c0 * std::exp(-2.0) * 45.9 * 45.9 * (speed / (speed + 2.0)) / (speed + 2.0) * height;
}

}  // namespace limen::perception
