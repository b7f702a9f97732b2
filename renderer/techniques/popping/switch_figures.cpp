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

/// No table holds infinity, which an eye within the object's bounds gives.
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
    // A frame with passes of its own, so that the technique's are not mixed with these.
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
  const auto fact = [](const char* name, double value, const char* unit = "") {
    return Counter{name, value, unit, false};
  };
  const auto triangles = [&](int level) { return double(object.levels[size_t(level)].triangleCount); };
  return {fact("rating", any ? highest->rating : ratingWithoutRegion(setting.popping)),
          fact("detection_probability", any ? setting.popping.detection.probability(highest->rating)
                                            : setting.popping.detection.guessRate),
          fact("has_region", any ? 1.0 : 0.0),
          fact("sigma_jnd", any ? highest->sigma : 0.0, "JND"),
          fact("regions", static_cast<double>(regions.size())),
          fact("largest_region_px", static_cast<double>(largestPx), "px"),
          fact("popping_px", static_cast<double>(poppingPx), "px"),
          fact("coverage_of_object", finding.regions.coverageOf(mask)),
          fact("largest_jnd", finding.largestJnd, "JND"),
          fact("max_de94", perception::largestColourDifference(images.input, setting.display).value, "dE94"),
          fact("flushed_inputs", static_cast<double>(finding.flushedInputs)),
          fact("guarded_contrasts", static_cast<double>(finding.guardedContrasts)),
          fact("object_px", static_cast<double>(std::count(mask.data.begin(), mask.data.end(), 1.0F)), "px"),
          fact("object_distance", scene::viewDistance(object, frame.camera()), "world units"),
          fact("object_extent_px", bounded(scene::screenExtentPx(object, view)), "px"),
          fact("screen_error_px",
               bounded(std::max(scene::screenErrorPx(object, setting.fromLevel, view),
                                scene::screenErrorPx(object, setting.toLevel, view))),
               "px"),
          fact("screen_velocity_deg_s",
               perception::screenVelocityDegS(meanDisplacementPx(images.input.actualDisplacement, mask),
                                              setting.display.refreshHz, ppd),
               "deg/s"),
          fact("pixels_per_degree", ppd, "px/deg"),
          fact("triangles_before", triangles(setting.fromLevel)),
          fact("triangles_after", triangles(setting.toLevel))};
}

std::vector<Quantity> switchFigureNames() {
  return {"rating",
          "detection_probability",
          "has_region",
          "sigma_jnd",
          "regions",
          "largest_region_px",
          "popping_px",
          "coverage_of_object",
          "largest_jnd",
          "max_de94",
          "flushed_inputs",
          "guarded_contrasts",
          "object_px",
          "object_distance",
          "object_extent_px",
          "screen_error_px",
          "screen_velocity_deg_s",
          "pixels_per_degree",
          "triangles_before",
          "triangles_after"};
}

Image regionPicture(const SwitchImages& images, const perception::RegionMap& regions) {
  return perception::poppingOverlay(perception::displayPicture(images.input.actual), regions,
                                    {.opacity = 0.65, .outlines = true, .legend = false});
}

}  // namespace limen::techniques
