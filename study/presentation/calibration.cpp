// SPDX-License-Identifier: BSD-3-Clause
#include "study/presentation/calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "experiments/base/error.h"
#include "perception/vision/colour.h"

namespace limen::study {
namespace {

constexpr double kLeastGamma = 0.4, kMostGamma = 6.0;  ///< of photometer readings
constexpr double kDarkestShare = 1e-4;  ///< of the brightest reading, down to which readings are meaningful
constexpr double kDimmestWhiteCdM2 = 1e-3, kBrightestCdM2 = 1e7;  ///< of anything that is a display
constexpr double kLargestFall = 0.02;  ///< drop of luminance with rising level, as a share of the range
const char* const kPhotometer = "photometer readings";

void check(const std::vector<Reading>& readings) {
  std::set<double> levels;
  for (const Reading& reading : readings) {
    if (!(reading.level >= 0.0 && reading.level <= 1.0))
      throw Error(fmt::format("level {}", reading.level), kPhotometer,
                  "levels are pixel values from 0 to 1; divide codes by 255");
    if (!(reading.cdM2 >= 0.0 && std::isfinite(reading.cdM2)))
      throw Error(fmt::format("{} cd/m2 at level {}", reading.cdM2, reading.level), kPhotometer,
                  "luminances cannot be negative");
    levels.insert(reading.level);
  }
  if (levels.size() < 4)
    throw Error(fmt::format("{} levels", levels.size()), kPhotometer,
                "measure at least four, preferably nine or more");
  if (*levels.begin() > 0.1 || *levels.rbegin() < 0.9)
    throw Error(fmt::format("levels from {} to {}", *levels.begin(), *levels.rbegin()), kPhotometer,
                "measure black and white too");
  std::vector<Reading> rising = readings;
  std::stable_sort(rising.begin(), rising.end(),
                   [](const Reading& a, const Reading& b) { return a.level < b.level; });
  const auto [least, most] = std::minmax_element(
      rising.begin(), rising.end(), [](const Reading& a, const Reading& b) { return a.cdM2 < b.cdM2; });
  if (!(most->cdM2 >= kDimmestWhiteCdM2 && most->cdM2 <= kBrightestCdM2))
    throw Error(fmt::format("a white of {} cd/m2", most->cdM2), kPhotometer,
                "no display has that; luminances are in cd/m2");
  const double range = most->cdM2 - least->cdM2;
  if (!(range > 0.0)) throw Error("all levels have the same luminance", kPhotometer, "is the display on?");
  for (size_t i = 1; i < rising.size(); ++i)
    if (rising[i].cdM2 < rising[i - 1].cdM2 - kLargestFall * range)
      throw Error(fmt::format("luminance falls from {} cd/m2 at level {} to {} at {}", rising[i - 1].cdM2,
                              rising[i - 1].level, rising[i].cdM2, rising[i].level),
                  kPhotometer, "measure these two again");
}

/// A photometer's error is relative to its reading, down to its last digits.
double errorOf(const Reading& reading, double brightestCdM2) {
  return reading.cdM2 + kDarkestShare * brightestCdM2;
}

struct Candidate {
  TransferFit fit;
  double sum = 0.0;  ///< sum of squared residuals over errors: what is minimised
};

/// Black and peak by linear least squares for a given curve.
Candidate fitEnds(const std::vector<Reading>& readings, const std::function<double(double)>& curve) {
  double brightest = 0.0;
  for (const Reading& reading : readings) brightest = std::max(brightest, reading.cdM2);
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const Reading& reading : readings) {
    const double x = curve(reading.level), weight = std::pow(errorOf(reading, brightest), -2);
    n += weight, sx += weight * x, sy += weight * reading.cdM2;
    sxx += weight * x * x, sxy += weight * x * reading.cdM2;
  }
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  Candidate out;
  TransferFit& fit = out.fit;
  fit.blackCdM2 = (sy - slope * sx) / n;
  if (fit.blackCdM2 < 0.0) {  // no display is darker than dark
    fit.blackCdM2 = 0.0;
    fit.peakCdM2 = sxy / sxx;
  } else {
    fit.peakCdM2 = fit.blackCdM2 + slope;
  }
  double squares = 0.0;
  for (const Reading& reading : readings) {
    const double residual =
        reading.cdM2 - (fit.blackCdM2 + (fit.peakCdM2 - fit.blackCdM2) * curve(reading.level));
    fit.residualCdM2.push_back(residual);
    squares += residual * residual;
    out.sum += std::pow(residual / errorOf(reading, brightest), 2);
    fit.largestShare = std::max(fit.largestShare, std::abs(residual) / (fit.peakCdM2 - fit.blackCdM2));
  }
  fit.rmsCdM2 = std::sqrt(squares / static_cast<double>(readings.size()));
  return out;
}

Candidate bestGamma(const std::vector<Reading>& readings) {
  const auto fit = [&](double gamma) {
    Candidate out = fitEnds(readings, [gamma](double level) { return std::pow(level, gamma); });
    out.fit.gamma = gamma;
    return out;
  };
  // The residual has one minimum over gamma near the curve; a coarse scan keeps the search away from others.
  double best = kLeastGamma, least = 1e300;
  constexpr double kStep = 0.1;
  for (double gamma = kLeastGamma; gamma <= kMostGamma; gamma += kStep)
    if (const double sum = fit(gamma).sum; sum < least) least = sum, best = gamma;
  double low = best - kStep, high = best + kStep;
  for (int i = 0; i < 80; ++i) {
    const double third = (high - low) / 3.0;
    if (fit(low + third).sum < fit(high - third).sum)
      high -= third;
    else
      low += third;
  }
  return fit(0.5 * (low + high));
}

Candidate bestSrgb(const std::vector<Reading>& readings) {
  Candidate out = fitEnds(readings, perception::decodeSrgb);
  out.fit.curve = perception::TransferCurve::Srgb;
  return out;
}

TransferFit accepted(TransferFit fit, const std::vector<Reading>& readings) {
  if (fit.largestShare <= kLargestResidual) return fit;
  const auto worst = std::max_element(fit.residualCdM2.begin(), fit.residualCdM2.end(),
                                      [](double a, double b) { return std::abs(a) < std::abs(b); });
  throw Error(
      fmt::format("no curve fits: at level {} the residual is {:+.3g} cd/m2, {:.1f} % of the range",
                  readings[static_cast<size_t>(worst - fit.residualCdM2.begin())].level, *worst,
                  100.0 * fit.largestShare),
      kPhotometer,
      "switch dynamic contrast, night light and colour profiles off, let the display warm up, measure again");
}

}  // namespace

double pitchFromCard(double cardWidthPx) {
  const double pitchM = kCardWidthM / cardWidthPx;
  if (!(pitchM >= 2e-5 && pitchM <= 2e-3))
    throw Error(
        fmt::format("a card {} px wide", cardWidthPx), {},
        fmt::format("a card of 85.60 mm is {:.0f} to {:.0f} px wide on displays with pixels of 2 to 0.02 mm",
                    kCardWidthM / 2e-3, kCardWidthM / 2e-5));
  return pitchM;
}

TransferFit fitGamma(const std::vector<Reading>& readings) {
  check(readings);
  return accepted(bestGamma(readings).fit, readings);
}

TransferFit fitSrgb(const std::vector<Reading>& readings) {
  check(readings);
  return accepted(bestSrgb(readings).fit, readings);
}

TransferFit fitTransfer(const std::vector<Reading>& readings) {
  check(readings);
  const Candidate gamma = bestGamma(readings), srgb = bestSrgb(readings);
  return accepted(gamma.sum < srgb.sum ? gamma.fit : srgb.fit, readings);
}

MatchFit fitMatches(const std::vector<Match>& matches) {
  const char* const where = "visual matches";
  if (matches.empty()) throw Error("none", where, "give at least one, as 0.25=0.53");
  double products = 0.0, squares = 0.0;
  for (const Match& match : matches) {
    if (!(match.proportion > 0.0 && match.proportion < 1.0 && match.level > 0.0 && match.level < 1.0))
      throw Error(fmt::format("{}={}", match.proportion, match.level), where,
                  "both must lie between 0 and 1");
    products += std::log(match.proportion) * std::log(match.level);
    squares += std::log(match.level) * std::log(match.level);
  }
  MatchFit out;
  out.gamma = products / squares;
  if (!(out.gamma >= 1.0 && out.gamma <= 4.0))
    throw Error(fmt::format("a gamma of {:.3g}", out.gamma), where,
                "displays have 1 to 4: is each match PROPORTION=LEVEL, the proportion of white first?");
  for (const Match& match : matches) {
    out.residual.push_back(match.proportion - std::pow(match.level, out.gamma));
    out.largestResidual = std::max(out.largestResidual, std::abs(out.residual.back()));
  }
  if (out.largestResidual > kLargestMatchResidual)
    throw Error(
        fmt::format("the matches do not agree: one is {:.3f} off a gamma of {:.3g}", out.largestResidual,
                    out.gamma),
        where,
        "repeat them from farther away; a display that does not follow a power law needs a photometer");
  return out;
}

}  // namespace limen::study
