// SPDX-License-Identifier: BSD-3-Clause
// Defects of visibility images that a mean error hides: leaks, acne, gaps at contacts and banding.
#include <algorithm>
#include <cmath>
#include <vector>

#include "perception/metrics/comparison.h"
#include "perception/metrics/row_sums.h"

namespace limen::perception {
namespace {

constexpr double kUmbraBelow = 0.02;  ///< reference visibility that counts as full shadow
constexpr double kLeakAbove = 0.05;   ///< excess of light in full shadow that counts as a leak
constexpr double kShadowBelow = 0.5;  ///< reference visibility that counts as shadow beside a contact
constexpr double kGapAbove = 0.25;    ///< excess of light there that counts as a gap
constexpr double kAcneBelow = 0.98;   ///< visibility of a fully lit point that counts as acne

bool leaks(double reference, double error) { return reference < kUmbraBelow && error > kLeakAbove; }
bool isAcne(double reference, double error) { return reference == 1.0 && reference + error < kAcneBelow; }

/// Share of the receivers with the defect. A non-finite value is a leak in full shadow and acne in full
/// light.
template <class Defect>
MetricResult shareWith(const ComparisonInput& input, const std::string& metric, Defect defect) {
  const Comparison pair(input, metric, Region::Receivers);
  pair.requireVisibility(metric);
  MetricResult result;
  result.evaluatedPixels = pair.evaluatedPixels();
  Image map(pair.width(), pair.height(), 1);
  const double count = sumRows(pair.height(), static_cast<size_t>(pair.width()), [&](int y) {
    double found = 0.0;
    for (int x = 0; x < pair.width(); ++x) {
      if (!pair.evaluates(x, y)) continue;
      const bool finite = std::isfinite(pair.test().at(x, y));
      const double reference = pair.reference().at(x, y);
      const double error = finite ? pair.error(x, y, 0) : reference < 0.5 ? 1.0 : -1.0;
      if (!defect(reference, error)) continue;
      found += 1.0;
      map.at(x, y) = static_cast<float>(std::abs(error));
    }
    return found;
  });
  if (result.evaluatedPixels > 0) result.value = count / static_cast<double>(result.evaluatedPixels);
  result.map = std::move(map);
  result.mapName = metric;
  return result;
}

/// Longest run of pixels in a row or column that are too light where the reference has shadow. A shadow that
/// a bias detaches from its caster leaves a run as long as the gap, however small its share of the image.
MetricResult measureContactGap(const ComparisonInput& input, const NoMetricSettings&) {
  const Comparison pair(input, "contact_gap", Region::Receivers);
  pair.requireVisibility("contact_gap");
  MetricResult result;
  result.evaluatedPixels = pair.evaluatedPixels();
  const auto isGap = [&](int x, int y) {
    if (!pair.evaluates(x, y) || !(pair.reference().at(x, y) < kShadowBelow)) return false;
    return !std::isfinite(pair.test().at(x, y)) || pair.error(x, y, 0) > kGapAbove;
  };
  int longest = 0;
  std::vector<int> column(static_cast<size_t>(pair.width()), 0);
  for (int y = 0; y < pair.height(); ++y) {
    int row = 0;
    for (int x = 0; x < pair.width(); ++x) {
      int& above = column[static_cast<size_t>(x)];
      const bool gap = isGap(x, y);
      row = gap ? row + 1 : 0;
      above = gap ? above + 1 : 0;
      longest = std::max({longest, row, above});
    }
  }
  result.value = longest;
  return result;
}

/// Largest step of `value` between neighbours (right and below) that are both evaluated.
template <class Value>
double largestStep(const Comparison& pair, Value value) {
  double largest = 0.0;
  for (int y = 0; y < pair.height(); ++y)
    for (int x = 0; x < pair.width(); ++x) {
      if (!pair.evaluates(x, y)) continue;
      if (x + 1 < pair.width() && pair.evaluates(x + 1, y))
        largest = std::max(largest, std::abs(value(x + 1, y) - value(x, y)));
      if (y + 1 < pair.height() && pair.evaluates(x, y + 1))
        largest = std::max(largest, std::abs(value(x, y + 1) - value(x, y)));
    }
  return largest;
}

MetricResult measureBandStep(const ComparisonInput& input, const ComparedRegion& settings) {
  const Comparison pair(input, "band_step", settings.region);
  pair.requireVisibility("band_step");
  const auto reference = [&](int x, int y) { return double{pair.reference().at(x, y)}; };
  const auto test = [&](int x, int y) { return reference(x, y) + pair.error(x, y, 0); };
  MetricResult result;
  result.evaluatedPixels = pair.evaluatedPixels();
  result.value = largestStep(pair, test) - largestStep(pair, reference);
  return result;
}

const RegisteredMetric<NoMetricSettings> kLeaks{
    {.name = "leaks",
     .summary =
         "share of receivers in full shadow (reference below 0.02) that get more than 0.05 too much light",
     .title = "Share of receivers that leak"},
    [](const ComparisonInput& input, const NoMetricSettings&) { return shareWith(input, "leaks", leaks); }};
const RegisteredMetric<NoMetricSettings> kAcne{
    {.name = "acne",
     .summary = "share of receivers that are fully lit in the reference but below 0.98",
     .title = "Share of receivers with acne"},
    [](const ComparisonInput& input, const NoMetricSettings&) { return shareWith(input, "acne", isAcne); }};
const RegisteredMetric<NoMetricSettings> kContactGap{
    {.name = "contact_gap",
     .summary = "longest run of pixels in a row or column that are in shadow (reference below 0.5) and get "
                "more than 0.25 too much light: how far shadows are detached from their casters",
     .title = "Longest gap at a contact",
     .unit = "px"},
    &measureContactGap};
const RegisteredMetric<ComparedRegion> kBandStep{
    {.name = "band_step",
     .summary = "largest step between neighbouring pixels, minus that of the reference (bands, level "
                "discontinuities); use region: penumbra if the reference has hard edges",
     .title = "Largest step beyond the reference's"},
    &measureBandStep};

}  // namespace
}  // namespace limen::perception
