// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/popping/switch_figures.h"

#include <algorithm>
#include <cmath>

#include "perception/metrics/error_map.h"
#include "perception/popping/comparator.h"
#include "perception/popping/overlay.h"
#include "perception/vision/eye_movement.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/scene/lod_control.h"

namespace limen::techniques {
namespace {

/// Tables cannot hold infinity, which an eye inside the object's bounds gives.
double bounded(double value) { return std::min(value, 1e9); }

/// Mean length of the object's displacement in the new frame [px per frame].
double meanDisplacementPx(const Image& displacement, const Image& mask) {
  if (displacement.data.empty()) return 0.0;
  double sum = 0.0;
  int64_t pixels = 0;
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x) {
      if (!(mask.at(x, y) > 0.0F)) continue;
      ++pixels;
      sum += std::hypot(displacement.at(x, y, 0), displacement.at(x, y, 1));
    }
  return pixels > 0 ? sum / static_cast<double>(pixels) : 0.0;
}

}  // namespace

Image objectMask(frame::Frame& frame, const SwitchSetting& setting) {
  const auto [actual, predicted] = setting.levels(frame);
  const scene::LodObject& object = frame.scene().lodObjects[setting.object];
  const glm::ivec2 sizePx = frame.sizePx();
  Image mask(sizePx.x, sizePx.y, 1);
  for (const scene::LodSelection* selection : {&actual, &predicted}) {
    const scene::TriangleRange range = frame.scene().triangles(object, selection->levels[setting.object]);
    // A frame with its own passes, so that they do not mix with the technique's.
    frame::Frame view(frame.context(), frame.scene(), frame.gpuScene(), sizePx, frame.timeS(),
                      frame.raster());
    view.setLevels(*selection);
    view.begin();
    const std::vector<uint32_t> ids = view.get<frame::TriangleIds>().texture().readUint();
    view.end();
    for (size_t pixel = 0; pixel < ids.size(); ++pixel)
      if (ids[pixel] >= range.first && ids[pixel] - range.first < range.count) mask.data[pixel] = 1.0F;
  }
  return mask;
}

double ratingWithoutRegion(const perception::PoppingSettings& settings) {
  return perception::poppingRating(settings.regions.thresholdJnd, settings) - 1.0;
}

std::vector<Counter> switchFigures(frame::Frame& frame, const SwitchSetting& setting,
                                   const SwitchImages& images, const SwitchFinding& finding) {
  const std::vector<perception::PoppingRegion>& regions = finding.regions.regions;
  const auto highest = std::max_element(regions.begin(), regions.end(),
                                        [](const auto& a, const auto& b) { return a.rating < b.rating; });
  const bool any = highest != regions.end();
  int64_t poppingPx = 0, largestPx = 0;
  for (const perception::PoppingRegion& region : regions) {
    poppingPx += region.sizePx;
    largestPx = std::max(largestPx, region.sizePx);
  }
  const Image mask = objectMask(frame, setting);
  const scene::Scene& scene = frame.scene();
  const scene::LodObject& object = scene.lodObjects[setting.object];
  const scene::LodView view{frame.camera(), frame.sizePx().y};
  const double ppd = setting.display.pixelsPerDegree();
  const auto triangles = [&](int level) { return double(object.levels[size_t(level)].triangleCount); };
  return {{"rating", any ? highest->rating : ratingWithoutRegion(setting.popping)},
          {"detection_probability", any ? setting.popping.detection.probability(highest->rating)
                                        : setting.popping.detection.guessRate},
          {"has_region", any ? 1.0 : 0.0},
          {"sigma_jnd", any ? highest->sigma : 0.0},
          {"regions", static_cast<double>(regions.size())},
          {"largest_region_px", static_cast<double>(largestPx)},
          {"popping_px", static_cast<double>(poppingPx)},
          {"coverage_of_object", finding.regions.coverageOf(mask)},
          {"largest_jnd", finding.largestJnd},
          {"max_de94", perception::largestColourDifference(images.input, setting.display).value},
          {"flushed_inputs", static_cast<double>(finding.flushedInputs)},
          {"guarded_contrasts", static_cast<double>(finding.guardedContrasts)},
          {"object_px", static_cast<double>(std::count(mask.data.begin(), mask.data.end(), 1.0F))},
          {"object_distance", scene::viewDistance(object, frame.camera())},
          {"object_extent_px", bounded(scene::screenExtentPx(object, view))},
          {"screen_error_px", bounded(std::max(scene::screenErrorPx(object, setting.fromLevel, view),
                                               scene::screenErrorPx(object, setting.toLevel, view)))},
          {"screen_velocity_deg_s",
           perception::screenVelocityDegS(meanDisplacementPx(images.input.actualDisplacement, mask),
                                          setting.display.refreshHz, ppd)},
          {"pixels_per_degree", ppd},
          {"triangles_before", triangles(setting.fromLevel)},
          {"triangles_after", triangles(setting.toLevel)}};
}

std::vector<Quantity> switchFigureQuantities() {
  const Direction none = Direction::Neither;
  return {{"rating", "Rating", "", none, "Schwarz 2009, section 10.3.4"},
          {"detection_probability", "Probability of detection", "", none},
          {"has_region", "Has a popping region", "", none},
          {"sigma_jnd", "Sigma of the region with the highest rating", "JND", none},
          {"regions", "Popping regions", "", none},
          {"largest_region_px", "Largest popping region", "px", none},
          {"popping_px", "Pixels in popping regions", "px", none},
          {"coverage_of_object", "Share of the object in popping regions", "", none},
          {"largest_jnd", "Largest difference", "JND", none},
          {"max_de94", "Largest colour difference", "dE94", none},
          {"flushed_inputs", "Inputs replaced by 0", "", none},
          {"guarded_contrasts", "Contrasts with a bounded denominator", "", none},
          {"object_px", "Pixels of the object", "px", none},
          {"object_distance", "Distance of the object", "world units", none},
          {"object_extent_px", "Screen height of the object", "px", none},
          {"screen_error_px", "Largest screen-space deviation", "px", none},
          {"screen_velocity_deg_s", "Screen velocity", "deg/s", none},
          {"pixels_per_degree", "Pixels per degree", "px/deg", none},
          {"triangles_before", "Triangles before the change", "", none},
          {"triangles_after", "Triangles after the change", "", none}};
}

Image regionPicture(const SwitchImages& images, const perception::RegionMap& regions) {
  return perception::poppingOverlay(perception::displayPicture(images.input.actual), regions,
                                    {.opacity = 0.65, .outlines = true, .legend = false});
}

}  // namespace limen::techniques
