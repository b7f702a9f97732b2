// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {

/// Pixels where two pictures differ by more than `tolerance` in some channel, and the largest difference
/// elsewhere; a value that is not finite differs from all.
struct Differing {
  size_t count = 0;
  double largestElsewhere = 0.0;
};

inline Differing differing(const Image& a, const Image& b, double tolerance) {
  Differing out;
  for (size_t i = 0; i < a.pixels(); ++i) {
    double largest = 0.0;
    for (size_t c = 0; c < 3; ++c) {
      const double difference =
          std::abs(double(a.data[i * size_t(a.channels) + c]) - b.data[i * size_t(b.channels) + c]);
      largest = std::max(largest, std::isfinite(difference) ? difference : 1e30);
    }
    if (largest > tolerance)
      ++out.count;
    else
      out.largestElsewhere = std::max(out.largestElsewhere, largest);
  }
  return out;
}

/// Scenes of a mirror and little else.
class ReflectionTest : public TechniqueTest {
 protected:
  static scene::Material mirrorMaterial(float share) {
    scene::Material material;
    material.name = "mirror";
    material.albedo = glm::vec3(0.02F);
    material.mirror = glm::vec3(share);
    return material;
  }
  static std::vector<uint32_t> seenTriangles(const scene::Scene& scene, glm::ivec2 sizePx) {
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, sizePx);
    frame.begin();
    std::vector<uint32_t> ids = frame.get<frame::TriangleIds>().texture().readUint();
    frame.end();
    return ids;
  }
};

}  // namespace limen::techniques
