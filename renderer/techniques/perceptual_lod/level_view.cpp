// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/perceptual_lod/level_view.h"

#include <algorithm>
#include <cmath>

namespace limen::techniques {

PixelRect pixelsOf(const scene::Bounds& bounds, const frame::Frame& frame) {
  const glm::ivec2 size = frame.sizePx();
  if (bounds.empty()) return {};
  glm::dvec2 low(1e300), high(-1e300);
  int behind = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 world(corner & 1 ? bounds.high.x : bounds.low.x,
                           corner & 2 ? bounds.high.y : bounds.low.y,
                           corner & 4 ? bounds.high.z : bounds.low.z);
    const glm::dvec3 p(frame.anchorToCamera() * glm::dvec4(world - frame.gpuScene().anchor(), 1.0));
    if (p.z > -1e-9 * (1.0 + std::abs(p.x) + std::abs(p.y))) {
      ++behind;
      continue;
    }
    const glm::dvec2 ndc(p.x / (-p.z * frame.tanHalfFov() * frame.aspect()),
                         p.y / (-p.z * frame.tanHalfFov()));
    const glm::dvec2 at = (glm::dvec2(ndc.x, -ndc.y) * 0.5 + 0.5) * glm::dvec2(size);
    low = glm::min(low, at);
    high = glm::max(high, at);
  }
  if (behind == 8) return {};
  if (behind > 0) return {glm::ivec2(0), size};
  // One more pixel on each side for the raster's rounding.
  const glm::dvec2 limit(size);
  return {glm::ivec2(glm::clamp(glm::floor(low) - 1.0, glm::dvec2(0.0), limit)),
          glm::ivec2(glm::clamp(glm::ceil(high) + 1.0, glm::dvec2(0.0), limit))};
}

scene::LodSelection nothingOf(const scene::Scene& scene) {
  return {std::vector<int>(scene.lodObjects.size(), scene::LodSelection::kOmitted), false};
}

scene::LodSelection onlyObject(const scene::Scene& scene, int object, int level) {
  scene::LodSelection out = nothingOf(scene);
  out.levels[static_cast<size_t>(object)] = level;
  return out;
}

}  // namespace limen::techniques
