// SPDX-License-Identifier: BSD-3-Clause
#include "perception/vision/adaptation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "perception/vision/csf_models.h"

namespace limen::perception {
namespace {

constexpr double kReferenceCdM2 = 100.0;  ///< where Daly's constants hold
constexpr double kC0 = 1.14, kC1 = 0.67;
constexpr double kLeastCdM2 = 1e-4, kLargestCdM2 = 1e4;
constexpr double kLeastAreaDeg2 = 1e-4, kLargestAreaDeg2 = 1e6;

double clampLuminance(double l) { return l > kLeastCdM2 ? std::min(l, kLargestCdM2) : kLeastCdM2; }
double clampArea(double area) {
  return area > kLeastAreaDeg2 ? std::min(area, kLargestAreaDeg2) : kLeastAreaDeg2;
}

}  // namespace

Csf::Peak barten03Peak(double luminanceCdM2, double areaDeg2) {
  const double l = clampLuminance(luminanceCdM2), area = clampArea(areaDeg2);
  // The slope of ln csf over x = rho^2 is
  //   -o - 0.32 / (p + 0.64 x) + 0.01 e / ((1 - e)^2 (q + 1 / (1 - e))),  e = exp(-0.02 x),
  // positive below the peak and negative above. Its root is as exact as the arithmetic, whereas a search for
  // the maximum only finds half the digits. With s = 1 - e the last term is 0.01 (1 - s) / (s (q s + 1)).
  const double o = 0.0016 * std::pow(1.0 + 100.0 / l, 0.08), p = 1.0 + 144.0 / area;
  const double q = 63.0 / std::pow(l, 0.83);
  const auto slope = [&](double lnX) {
    const double x = std::exp(lnX), s = -std::expm1(-0.02 * x);
    return -o - 0.32 / (p + 0.64 * x) + 0.01 * (1.0 - s) / (s * (q * s + 1.0));
  };
  // Regula falsi after Illinois, over rho in [1e-3, 60] cpd; times x, the slope bends less.
  const auto scaled = [&](double lnX) { return slope(lnX) * std::exp(lnX); };
  double low = 2.0 * std::log(1e-3), high = 2.0 * std::log(60.0);
  double atLow = scaled(low), atHigh = scaled(high), root = low;
  for (int i = 0; i < 100 && high - low > 1e-15 * std::abs(high + low) + 1e-15; ++i) {
    root = (low * atHigh - high * atLow) / (atHigh - atLow);
    const double at = scaled(root);
    if (at == 0.0) break;
    if (at > 0.0) {
      if (root <= low) break;
      low = root, atLow = at, atHigh *= i % 3 == 2 ? 0.25 : 0.5;
    } else {
      if (root >= high) break;
      high = root, atHigh = at, atLow *= i % 3 == 2 ? 0.25 : 0.5;
    }
  }
  const double rho = std::exp(0.5 * root);
  return {rho, csfBarten03(rho, l, area)};
}

double daly98C0(double luminanceCdM2, double areaDeg2) {
  return kC0 * barten03Peak(luminanceCdM2, areaDeg2).sensitivity /
         barten03Peak(kReferenceCdM2, areaDeg2).sensitivity;
}

double daly98C1(double luminanceCdM2, double areaDeg2) {
  return kC1 * barten03Peak(kReferenceCdM2, areaDeg2).frequencyCpd /
         barten03Peak(luminanceCdM2, areaDeg2).frequencyCpd;
}

double pupilDiameterMm(double luminanceCdM2) {
  return 5.0 - 3.0 * std::tanh(0.4 * std::log10(clampLuminance(luminanceCdM2)));
}

double retinalIlluminanceTd(double luminanceCdM2) {
  const double d = pupilDiameterMm(luminanceCdM2);
  return clampLuminance(luminanceCdM2) * std::numbers::pi * d * d / 4.0;
}

double chromaticScale(double luminanceCdM2, double referenceCdM2) {
  return std::sqrt(retinalIlluminanceTd(luminanceCdM2) / retinalIlluminanceTd(referenceCdM2));
}

}  // namespace limen::perception
