// SPDX-License-Identifier: BSD-3-Clause
#include "perception/vision/csf.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "perception/vision/csf_arguments.h"

namespace limen::perception {
namespace {

constexpr double kLowCpd = 0.05, kHighCpd = 60.0;

// Of a smooth function near its maximum: Newton on the logarithm's slope by five-point differences, which
// finds the position to 1e-10, whereas comparing values ends at 1e-8. Discarded if it does not converge
// nearby.
double refine(const std::function<double(double)>& value, double x) {
  constexpr double kStep = 4e-3;
  const double start = x;
  for (int round = 0; round < 3; ++round) {
    std::array<double, 5> f{};
    for (int i = 0; i < 5; ++i) {
      const double v = value(x + (i - 2) * kStep);
      if (!(v > 0.0)) return start;
      f[static_cast<size_t>(i)] = std::log(v);
    }
    const double slope = (f[0] - 8.0 * f[1] + 8.0 * f[3] - f[4]) / (12.0 * kStep);
    const double bend = (-f[0] + 16.0 * f[1] - 30.0 * f[2] + 16.0 * f[3] - f[4]) / (12.0 * kStep * kStep);
    if (!(bend < -1e-6)) return start;
    x -= slope / bend;
    if (std::abs(x - start) > 1e-3) return start;
  }
  return value(x) >= value(start) * (1.0 - 1e-14) ? x : start;
}

struct Member {
  const char* name;
  double CsfPoint::*member;
};
constexpr Member kMembers[] = {{"frequency_cpd", &CsfPoint::frequencyCpd},
                               {"velocity_deg_s", &CsfPoint::velocityDegS},
                               {"luminance_cd_m2", &CsfPoint::luminanceCdM2},
                               {"area_deg2", &CsfPoint::areaDeg2},
                               {"width_deg", &CsfPoint::widthDeg},
                               {"orientation_deg", &CsfPoint::orientationDeg},
                               {"eccentricity_deg", &CsfPoint::eccentricityDeg},
                               {"distance_m", &CsfPoint::distanceM}};

double CsfPoint::*memberOf(const std::string& name) {
  const auto* found = std::find_if(std::begin(kMembers), std::end(kMembers),
                                   [&](const Member& one) { return name == one.name; });
  assert(found != std::end(kMembers));
  return found->member;
}

}  // namespace

Csf::Peak Csf::peak(const CsfPoint& point) const {
  const auto value = [&](double lnCpd) {
    CsfPoint at = point;
    at.frequencyCpd = std::exp(lnCpd);
    return sensitivity(at);
  };
  // A coarse scan first: some models have more than one maximum, or a plateau.
  constexpr int kSteps = 48;
  const double low = std::log(kLowCpd), step = (std::log(kHighCpd) - low) / kSteps;
  int best = 0;
  double bestValue = value(low);
  for (int i = 1; i <= kSteps; ++i)
    if (const double v = value(low + i * step); v > bestValue) best = i, bestValue = v;
  if (bestValue <= 0.0) return {kLowCpd, 0.0};
  // Golden section between the neighbours.
  constexpr double kGolden = 0.6180339887498949;
  double a = low + std::max(best - 1, 0) * step, b = low + std::min(best + 1, kSteps) * step;
  double x1 = b - kGolden * (b - a), x2 = a + kGolden * (b - a), f1 = value(x1), f2 = value(x2);
  while (b - a > 1e-8) {
    if (f1 >= f2) {
      b = x2, x2 = x1, f2 = f1, x1 = b - kGolden * (b - a), f1 = value(x1);
    } else {
      a = x1, x1 = x2, f1 = f2, x2 = a + kGolden * (b - a), f2 = value(x2);
    }
  }
  double place = 0.5 * (a + b);
  if (best > 0 && best < kSteps) place = refine(value, place);
  // The ends of the range, and a plateau, whose first point counts.
  if (const double v = value(place); v >= bestValue) return {std::exp(place), v};
  return {std::exp(low + best * step), bestValue};
}

const SettingsTable<CsfGain>& CsfGain::table() {
  static const SettingsTable<CsfGain> kTable = {
      {&CsfGain::value, "gain", {0.0, 1e6}, "", "factor on the sensitivity"}};
  return kTable;
}

std::unique_ptr<Csf> makeCsf(const std::string& name, const std::string& where) {
  const CsfInfo& info = CsfRegistry::instance().get(name, where);
  return info.make(ParameterValues(info.parameters, {}, where));
}

std::vector<std::string> csfNames(Channel channel) {
  std::vector<std::string> out;
  for (const auto& [name, info] : CsfRegistry::instance().all())
    if (info.channel == channel) out.push_back(name);
  return out;
}

double argumentOf(const CsfPoint& point, const std::string& name) { return point.*memberOf(name); }
double& argumentOf(CsfPoint& point, const std::string& name) { return point.*memberOf(name); }

const std::vector<std::string>& csfArgumentNames() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names;
    for (const Member& one : kMembers) names.emplace_back(one.name);
    return names;
  }();
  return kNames;
}

std::vector<std::string> outsideValidRange(const CsfInfo& info, const CsfPoint& point) {
  std::vector<std::string> out;
  for (const CsfArgument& one : info.arguments) {
    const double value = argumentOf(point, one.name);
    if (!(value >= one.validLow && value <= one.validHigh)) out.push_back(one.name);
  }
  return out;
}

}  // namespace limen::perception
