// SPDX-License-Identifier: BSD-3-Clause
#include "perception/command/popping_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "perception/metrics/quantile.h"
#include "perception/vision/masking.h"

namespace limen::perception {
namespace {

std::vector<const PoppingRegion*> byRating(const PoppingResult& result) {
  std::vector<const PoppingRegion*> out;
  for (const PoppingRegion& region : result.regions.regions) out.push_back(&region);
  std::stable_sort(out.begin(), out.end(),
                   [](const PoppingRegion* a, const PoppingRegion* b) { return a->rating > b->rating; });
  return out;
}

}  // namespace

std::string poppingModelText(const PoppingSettings& settings) {
  const SensitivitySettings& s = settings.sensitivity;
  std::string csfs = s.achromatic.csf.name + "+" + s.redGreen.csf.name;
  if (s.blueYellow.csf.name != s.redGreen.csf.name) csfs += "+" + s.blueYellow.csf.name;
  const std::string masking = isCubic(settings.masking) ? "T (9.9)" : "masking " + settings.masking.name;
  return fmt::format("model {}; {}, {}, eye movement {}", toText(settings.model), csfs, masking,
                     toText(settings.eyeModel()));
}

Figures declaredPoppingFigures() {
  return {
      {"rating",
       "",
       "highest rating R of a region; below 1 rarely visible, above 3 easily detected",
       false,
       {},
       {}},
      {"detection_probability", "", "probability that a viewer who attends to it reports it", false, {}, {}},
      {"region_count", "", "popping regions", false, {}, {}},
      {"coverage", "", "share of the image in popping regions", false, {}, {}},
      {"largest_jnd", "JND", "largest difference", false, {}, {}},
      {"mean_jnd", "JND", "mean difference", false, {}, {}},
      {"median_jnd", "JND", "median difference", false, {}, {}},
      {"p95_jnd", "JND", "95th percentile of the difference", false, {}, {}},
      {"p99_jnd", "JND", "99th percentile of the difference", false, {}, {}},
      {"visible_share", "", "share of pixels that differ by 1 JND or more", false, {}, {}}};
}

Figures poppingFigures(const PoppingResult& result) {
  Figures figures = declaredPoppingFigures();
  std::vector<double> jnd = result.jndExact;
  const auto visible = std::count_if(jnd.begin(), jnd.end(), [](double d) { return d >= 1.0; });
  const bool any = !result.regions.regions.empty();
  const double pixels = static_cast<double>(std::max<size_t>(jnd.size(), 1));
  const double values[] = {result.summary.largestRating,
                           result.summary.detectionProbability,
                           static_cast<double>(result.regions.regions.size()),
                           result.summary.coverage,
                           result.summary.largestJnd,
                           result.summary.meanJnd,
                           nearestRank(jnd, 0.5),
                           nearestRank(jnd, 0.95),
                           nearestRank(jnd, 0.99),
                           static_cast<double>(visible) / pixels};
  for (size_t i = 0; i < figures.size(); ++i) figures[i].value = values[i];
  // Without a region there is nothing to rate: minus infinity, which JSON cannot represent.
  if (!any || !std::isfinite(result.summary.largestRating)) figures[0].value.reset();
  return figures;
}

std::string regionTable(const PoppingResult& result, size_t most) {
  const std::vector<const PoppingRegion*> regions = byRating(result);
  if (regions.empty()) return "no popping region\n";
  std::string out = fmt::format("  {:>5} {:>9} {:>10} {:>8} {:>11} {:>9}  {}\n", "region", "size px",
                                "Sigma JND", "R", "largest JND", "detected", "box (x, y, width x height)");
  for (size_t i = 0; i < std::min(most, regions.size()); ++i) {
    const PoppingRegion& r = *regions[i];
    out += fmt::format("  {:>6} {:>9} {:>10.4g} {:>8.3f} {:>11.4g} {:>8.1f}%  {}, {}, {} x {}\n", r.label,
                       r.sizePx, r.sigma, r.rating, r.largestJnd, 100.0 * r.detectionProbability, r.least.x,
                       r.least.y, r.most.x - r.least.x + 1, r.most.y - r.least.y + 1);
  }
  if (regions.size() > most) out += fmt::format("  ... and {} more; --json has all\n", regions.size() - most);
  return out;
}

nlohmann::json regionsAsJson(const PoppingResult& result) {
  nlohmann::json out = nlohmann::json::array();
  for (const PoppingRegion* region : byRating(result)) {
    const PoppingRegion& r = *region;
    out.push_back({{"label", r.label},
                   {"size_px", r.sizePx},
                   {"sigma_jnd", r.sigma},
                   {"rating", r.rating},
                   {"largest_jnd", r.largestJnd},
                   {"detection_probability", r.detectionProbability},
                   {"coverage", r.coverage},
                   {"x_px", r.least.x},
                   {"y_px", r.least.y},
                   {"width_px", r.most.x - r.least.x + 1},
                   {"height_px", r.most.y - r.least.y + 1},
                   {"centroid_px", {r.centroidPx.x, r.centroidPx.y}}});
  }
  return out;
}

nlohmann::json poppingModelAsJson(const PoppingModel& model) {
  return {{"pixels_per_degree", model.pixelsPerDegree},
          {"area_deg2", model.areaDeg2},
          {"gaussian_levels", model.gaussianLevels},
          {"contrast_levels", model.contrastLevels},
          {"adaptation_level", model.adaptationLevel},
          {"peak_cpd", model.peakCpd},
          {"gain", model.gain},
          {"scale_achromatic", model.scaleA},
          {"scale_red_green", model.scaleRg},
          {"scale_blue_yellow", model.scaleBy}};
}

std::vector<std::string> poppingWarnings(const PoppingResult& result) {
  std::vector<std::string> out;
  if (result.flushedInputs > 0)
    out.push_back(
        fmt::format("{} non-finite values of the motion or weight maps counted as 0 (weights: as 1)",
                    result.flushedInputs));
  return out;
}

}  // namespace limen::perception
