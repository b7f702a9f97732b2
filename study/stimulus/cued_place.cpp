// SPDX-License-Identifier: BSD-3-Clause
#include "study/stimulus/cued_place.h"

#include <algorithm>
#include <cmath>

#include "renderer/frame/g_buffer.h"

namespace limen::study {
namespace {

/// Direction to a place of the window in camera space, one unit along the view.
glm::dvec3 rayTo(const frame::Frame& frame, glm::dvec2 placePx) {
  const glm::dvec2 size(frame.sizePx());
  const double tanHalf = frame.tanHalfFov();
  return {(2.0 * placePx.x / size.x - 1.0) * tanHalf * frame.aspect(),
          (1.0 - 2.0 * placePx.y / size.y) * tanHalf, -1.0};
}

/// Window place of a point in camera space; nothing behind the eye.
std::optional<glm::dvec2> placeOf(const frame::Frame& frame, const glm::dvec3& point) {
  if (!(point.z < 0.0)) return {};
  const glm::dvec2 size(frame.sizePx());
  const glm::dvec2 tangent(point.x / (-point.z * frame.tanHalfFov() * frame.aspect()),
                           point.y / (-point.z * frame.tanHalfFov()));
  return glm::dvec2(0.5 * (1.0 + tangent.x) * size.x, 0.5 * (1.0 - tangent.y) * size.y);
}

/// Linear depth behind a place; 0: background or outside the window.
double depthAt(frame::Frame& frame, glm::dvec2 placePx) {
  const glm::ivec2 pixel(glm::floor(placePx));
  if (pixel.x < 0 || pixel.y < 0 || pixel.x >= frame.sizePx().x || pixel.y >= frame.sizePx().y) return 0.0;
  frame.begin();
  const Image depth =
      frame.get<frame::GBufferChannel>(frame::ChannelSetting{frame::Channel::Depth}).texture().read();
  frame.end();
  return depth.at(pixel.x, pixel.y);
}

std::optional<glm::dvec2> followed(frame::Frame& frame, glm::dvec2 cuePx, double fromS, double toS) {
  frame.setTime(fromS);
  const glm::dvec3 ray = rayTo(frame, cuePx);
  const double depth = depthAt(frame, cuePx);
  // What is far away moves with the view's direction only.
  const glm::dvec4 seen(depth > 0.0 ? ray * depth : ray, depth > 0.0 ? 1.0 : 0.0);
  const glm::dvec4 anchored = glm::inverse(frame.anchorToCamera()) * seen;
  frame.setTime(toS);
  return placeOf(frame, glm::dvec3(frame.anchorToCamera() * anchored));
}

}  // namespace

std::optional<CuedPlace> cuedPlace(frame::Frame& frame, const Stimulus& stimulus, const Timeline& timeline,
                                   const perception::DisplayProfile& display) {
  const Cue& cue = stimulus.cue;
  if (cue.kind == Cue::Kind::None) return {};
  CuedPlace out;
  out.centrePx = {cue.xPx, cue.yPx};
  out.radiusPx = cue.kind == Cue::Kind::Circle ? cue.radiusPx : kArrowRadiusDeg * display.pixelsPerDegree();
  const double fromS = timeline.sceneTimeS(0), toS = timeline.changeSceneTimeS;
  if (fromS == toS) return out;
  const double before = frame.timeS();
  const std::optional<glm::dvec2> moved = followed(frame, out.centrePx, fromS, toS);
  frame.setTime(before);
  if (!moved) return {};
  out.centrePx = *moved;
  return out;
}

std::set<uint32_t> regionsAt(const perception::RegionMap& regions, const CuedPlace& place) {
  std::set<uint32_t> labels;
  const auto bounded = [](double value, int most) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(most)));
  };
  const glm::dvec2 least = place.centrePx - place.radiusPx, most = place.centrePx + place.radiusPx;
  for (int y = bounded(std::floor(least.y), regions.height); y < bounded(most.y + 1.0, regions.height); ++y)
    for (int x = bounded(std::floor(least.x), regions.width); x < bounded(most.x + 1.0, regions.width); ++x) {
      const uint32_t label = regions.labels[static_cast<size_t>(y) * regions.width + x];
      if (label && std::hypot(x + 0.5 - place.centrePx.x, y + 0.5 - place.centrePx.y) <= place.radiusPx)
        labels.insert(label);
    }
  return labels;
}

}  // namespace limen::study
