// SPDX-License-Identifier: BSD-3-Clause
//
// Burbeck and Kelly 1980 decompose the surface of Kelly 1979 into an excitation and an inhibition, each a
// product of a spatial and a temporal part. The numbers 10 cpd, 19 Hz, 0.5 cpd and 1 Hz choose the cuts
// through the surface that these parts are read from; as speeds they are 19 Hz / 10 cpd = 1.9 deg/s and 19 Hz
// / 0.5 cpd = 38 deg/s.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "perception/vision/csf_models.h"

namespace limen::perception {
namespace {

constexpr double kHighCpd = 10.0, kLowCpd = 0.5, kHighHz = 19.0, kLowHz = 1.0;

// csfKelly79(rho, omega / rho) with the quotient multiplied out, which rho = 0 would make infinite.
double kelly79AtHz(double rho, double omega) {
  constexpr double kPi = std::numbers::pi;
  if (!(rho > 0.0) || !(omega > 0.0) || std::isinf(rho) || std::isinf(omega)) return 0.0;
  const double decay = std::exp(-4.0 * kPi * (omega + 2.0 * rho) / 45.9);
  if (decay == 0.0) return 0.0;
  // For quotients too large or small for a double, the logarithm is split.
  const double lg = std::abs(std::log10(omega / 3.0) - std::log10(rho));
  return (6.1 + 7.3 * lg * lg * lg) * omega * 4.0 * kPi * kPi * rho * decay;
}

}  // namespace

double burbeckKellySpatialExcitation(double rho) {
  static const double kScale = kelly79AtHz(kHighCpd, kLowHz) / kelly79AtHz(kHighCpd, kHighHz);
  return rho <= kHighCpd ? kScale * kelly79AtHz(rho, kHighHz) : kelly79AtHz(rho, kLowHz);
}

double burbeckKellySpatialInhibition(double rho) {
  if (!(rho < kHighCpd)) return 0.0;  // exactly: the difference would leave rounding
  return burbeckKellySpatialExcitation(rho) - kelly79AtHz(rho, kLowHz);
}

double burbeckKellyTemporalExcitation(double omega) {
  static const double kScale = kelly79AtHz(kLowCpd, kHighHz) / kelly79AtHz(kHighCpd, kHighHz);
  return omega <= kHighHz ? kScale * kelly79AtHz(kHighCpd, omega) : kelly79AtHz(kLowCpd, omega);
}

double burbeckKellyTemporalInhibition(double omega) {
  if (!(omega < kHighHz)) return 0.0;
  return burbeckKellyTemporalExcitation(omega) - kelly79AtHz(kLowCpd, omega);
}

double burbeckKellyExcitation(double rho, double v) {
  static const double kNorm = burbeckKellySpatialExcitation(kLowCpd);
  if (std::isnan(rho) || std::isnan(v)) return 0.0;
  return burbeckKellySpatialExcitation(rho) * burbeckKellyTemporalExcitation(rho * std::abs(v)) / kNorm;
}

double burbeckKellyInhibition(double rho, double v) {
  static const double kNorm = burbeckKellySpatialInhibition(kLowCpd);
  if (std::isnan(rho) || std::isnan(v)) return 0.0;
  return burbeckKellySpatialInhibition(rho) * burbeckKellyTemporalInhibition(rho * std::abs(v)) / kNorm;
}

double csfBurbeckKelly80(double rho, double v) {
  return std::max(0.0, burbeckKellyExcitation(rho, v) - burbeckKellyInhibition(rho, v));
}

double csfKelly83(double rho, double v) {
  return std::max(0.0, burbeckKellyExcitation(rho, v) + burbeckKellyInhibition(rho, v)) / 30.0;
}

}  // namespace limen::perception
