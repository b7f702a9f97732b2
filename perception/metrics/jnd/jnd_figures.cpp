// SPDX-License-Identifier: BSD-3-Clause
#include "perception/metrics/jnd/jnd_figures.h"

#include "experiments/base/error.h"
#include "perception/metrics/error_map.h"
#include "perception/popping/overlay.h"

namespace limen::perception {

std::vector<Quantity> jndQuantities(const std::string& of) {
  const Direction lower = Direction::LowerIsBetter;
  // The one that stands for all of them first.
  return {{"p95", of + ", 95th percentile", "JND", lower},
          {"median", of + ", median", "JND", lower},
          {"largest", of + ", largest", "JND", lower},
          {"share_above_1", of + ", share of pixels of 1 JND or more", "", lower},
          {"rating", of + ", highest rating of a region", "", lower, "Schwarz 2009, section 10.3.4"},
          {"detection", of + ", probability of detection", "", lower, "Schwarz 2009, section 10.4"}};
}

std::vector<double> jndValues(const JndFigures& figures) {
  return {figures.p95Jnd,      figures.medianJnd, figures.largestJnd,
          figures.shareAbove1, figures.rating,    figures.detection};
}

MetricPicture regionPicture(const std::string& name, const Image& shown, const RegionMap& regions) {
  return {
      name,
      poppingOverlay(displayPicture(shown), regions, {.opacity = 0.65, .outlines = true, .legend = false}),
      true};
}

void requireShown(const ComparisonInput& input, const std::string& metric) {
  if (!input.gpu)
    throw Error("metric '" + metric + "' needs an OpenGL context", {}, "run it on a machine with OpenGL 4.5");
  if (input.depicts == Depicts::Nothing || input.depicts == Depicts::Items)
    throw Error("metric '" + metric + "' evaluates pictures, and this product is not one that a viewer sees",
                {}, "remove it for techniques whose product is a threshold, a change or a map");
  if (input.depicts == Depicts::ShareOfLight && (!input.surfaces || !input.surfaces->albedo))
    throw Error(
        "metric '" + metric + "' shows shares of light on the surfaces of a scene, and there are none", {},
        "run it in a sweep");
}

}  // namespace limen::perception
