// SPDX-License-Identifier: BSD-3-Clause
#include "perception/vision/tvi.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "perception/vision/csf_models.h"

namespace limen::perception {
namespace {

constexpr double kLeastAdaptedCdM2 = 1e-6, kLargestAdaptedCdM2 = 1e12;
constexpr double kMatchedCdM2 = 100.0;  ///< where TVI of CSFs are scaled to Ward's
constexpr double kLargestFactor = 1e12;

// Knots of (9.6) in lg cd/m2; branch i lies below knot i.
constexpr std::array<double, 4> kKnots = {-3.94, -1.44, -0.0184, 1.9};

double lgTviBranch(size_t branch, double l) {
  switch (branch) {
    case 0:
      return -2.86;
    case 1:
      // The base is negative below -3.9506, where the branch is never used.
      return std::pow(0.405 * l + 1.6, 2.18) - 2.86;
    case 2:
      return l - 0.395;
    case 3:
      return std::pow(0.249 * l + 0.65, 2.7) - 0.72;
    default:
      return l - 1.255;
  }
}

double lgLuminance(double luminanceCdM2) {
  return std::log10(luminanceCdM2 > 0.0 ? std::clamp(luminanceCdM2, kLeastAdaptedCdM2, kLargestAdaptedCdM2)
                                        : kLeastAdaptedCdM2);
}

size_t branchOf(double l) {
  return static_cast<size_t>(std::upper_bound(kKnots.begin(), kKnots.end(), l) - kKnots.begin());
}

}  // namespace

double tviWard(double luminanceCdM2) {
  const double l = lgLuminance(luminanceCdM2);
  return std::pow(10.0, lgTviBranch(branchOf(l), l));
}

double tviWardSmoothed(double luminanceCdM2) {
  static const std::array<double, 5> kShifts = [] {
    std::array<double, 5> shifts{};
    for (size_t i = kKnots.size(); i-- > 0;)
      shifts[i] = shifts[i + 1] + lgTviBranch(i + 1, kKnots[i]) - lgTviBranch(i, kKnots[i]);
    return shifts;
  }();
  const double l = lgLuminance(luminanceCdM2);
  const size_t branch = branchOf(l);
  return std::pow(10.0, lgTviBranch(branch, l) + kShifts[branch]);
}

double tviFromCsf(const Csf& csf, CsfPoint point) {
  point.luminanceCdM2 = point.luminanceCdM2 > 0.0
                            ? std::clamp(point.luminanceCdM2, kLeastAdaptedCdM2, kLargestAdaptedCdM2)
                            : kLeastAdaptedCdM2;
  // Where nothing is visible, no increment is; a finite one represents that.
  return std::min(point.luminanceCdM2 / std::max(csf.peak(point).sensitivity, 1.0 / kLargestFactor), 1e24);
}

double tviFromCsfScaled(const Csf& csf, CsfPoint point) {
  CsfPoint matched = point;
  matched.luminanceCdM2 = kMatchedCdM2;
  return tviFromCsf(csf, point) * (tviWard(kMatchedCdM2) / tviFromCsf(csf, matched));
}

std::vector<std::string> tviNames() { return {"ward", "ward_smoothed", "from_csf", "from_csf_scaled"}; }

std::function<double(double)> makeTvi(const std::string& name, std::shared_ptr<const Csf> csf,
                                      const CsfPoint& point, const std::string& where) {
  if (name == "ward") return tviWard;
  if (name == "ward_smoothed") return tviWardSmoothed;
  if (name == "from_csf" || name == "from_csf_scaled") {
    CsfPoint matched = point;
    matched.luminanceCdM2 = kMatchedCdM2;
    const double scale = name == "from_csf" ? 1.0 : tviWard(kMatchedCdM2) / tviFromCsf(*csf, matched);
    return [csf = std::move(csf), point, scale](double luminanceCdM2) {
      CsfPoint at = point;
      at.luminanceCdM2 = luminanceCdM2;
      return scale * tviFromCsf(*csf, at);
    };
  }
  throw Error("no TVI model '" + name + "'", where, suggest(name, tviNames()));
}

double frequencyFactor(const Csf& csf, const CsfPoint& point) {
  const double peak = csf.peak(point).sensitivity, here = csf.sensitivity(point);
  return peak >= kLargestFactor * here ? kLargestFactor : std::max(peak / here, 1.0);
}

double frequencyFactorActual(double frequencyCpd, double luminanceCdM2) {
  static const std::unique_ptr<Csf> kBarten = makeCsf("barten89");
  CsfPoint point;
  point.frequencyCpd = frequencyCpd;
  point.luminanceCdM2 = luminanceCdM2;
  return frequencyFactor(*kBarten, point);
}

double frequencyFactorOriginal(double frequencyCpd) {
  return frequencyCpd >= 4.0 ? frequencyFactorActual(frequencyCpd, 100.0) : 1.0;
}

}  // namespace limen::perception
