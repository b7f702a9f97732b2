// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/frame/shadow_map.h"
#include "renderer/techniques/soft_shadows/bitmask/light_samples.h"

namespace limen::techniques {

/// Brute force in double precision: every texel of a shadow map, seen from any point of the light, is a
/// micropatch that is thrown onto every light sample. No search area, no pyramid, no gap filling, no bits.
struct MaskTwin {
  Image map;        ///< linear depth
  Image receivers;  ///< relative to the map's eye
  frame::LightFrustum frustum;
  glm::dvec2 lightSize{1.0};
  double bias = 1e-4, slopeBias = 2.0, maxSlope = 10.0;  ///< the techniques' defaults

  /// Marks in `covered` the samples that the map's micropatches hide from a pixel.
  void cover(int px, int py, const std::vector<glm::dvec2>& samples, std::vector<bool>& covered) const {
    const glm::dvec3 p(receivers.at(px, py, 0), receivers.at(px, py, 1), receivers.at(px, py, 2));
    const glm::dvec2 extent = frustum.high - frustum.low;
    const double slope = std::min(double(receivers.at(px, py, 3)), maxSlope * p.z);
    const double limit =
        p.z - bias * p.z - slopeBias * slope * std::max(extent.x, extent.y) / double(map.width);
    for (int y = 0; y < map.height; ++y)
      for (int x = 0; x < map.width; ++x) {
        const double z = map.at(x, y);
        if (!(z < limit)) continue;
        // The ray from p through a corner of the texel at depth z meets the light's plane here.
        const auto thrown = [&](glm::dvec2 corner) {
          const glm::dvec2 q = (frustum.low + corner / double(map.width) * extent) * z;
          const glm::dvec2 onPlane = glm::dvec2(p) + (q - glm::dvec2(p)) * (p.z / (p.z - z));
          return (onPlane + frustum.offset) / lightSize + 0.5;
        };
        const glm::dvec2 low = thrown({x, y}), high = thrown({x + 1.0, y + 1.0});
        if (high.x <= 0.0 || high.y <= 0.0 || low.x >= 1.0 || low.y >= 1.0) continue;
        for (size_t i = 0; i < samples.size(); ++i)
          if (low.x < samples[i].x && samples[i].x <= high.x && low.y < samples[i].y &&
              samples[i].y <= high.y)
            covered[i] = true;
      }
  }
};

}  // namespace limen::techniques
