// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/references/embree_tracer.h"

#include <array>

#include "renderer/references/parallel.h"

namespace limen::references {
namespace {

ShadowCounts countSeen(const EmbreeScene& scene, const ReceiverPoint& point, const LightSamples& samples,
                       glm::dvec3 anchor) {
  ShadowCounts counts{0, 0};
  std::array<glm::dvec3, EmbreeScene::kPacket> lights;
  size_t filled = 0;
  const auto flush = [&] {
    counts.rays += static_cast<uint32_t>(filled);
    counts.seen +=
        static_cast<uint32_t>(filled) - scene.countOccluded(point, std::span(lights).first(filled));
    filled = 0;
  };
  for (int64_t sample = 0; sample < samples.count; ++sample) {
    const glm::dvec3 to = samples.point(point.pixel, sample) - anchor;
    if (!(glm::dot(point.normal, to - point.position) > 0.0)) continue;
    lights[filled++] = to;
    if (filled == lights.size()) flush();
  }
  flush();
  return counts;
}

}  // namespace

std::vector<ShadowCounts> EmbreeTracer::trace(const std::vector<ReceiverPoint>& points,
                                              const LightSamples& samples, glm::dvec3 anchor) {
  std::vector<ShadowCounts> counts(points.size());
  parallelFor(points.size(), [&](size_t, size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) counts[i] = countSeen(scene_, points[i], samples, anchor);
  });
  return counts;
}

}  // namespace limen::references
