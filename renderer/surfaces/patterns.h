// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "renderer/surfaces/patch_set.h"
#include "renderer/surfaces/pattern_slots.h"

namespace limen::surfaces {

/// One factor (number of segments) per side; the fourth is unused for triangles.
using Factors = std::array<int, 4>;

/// Tessellation pattern of a tuple of factors, each >= 1. See pattern_slots.h.
inline PatternPlan patternOf(Domain domain, const Factors& factors, bool cornerFix = true) {
  const ivec4 given(factors[0], factors[1], factors[2], factors[3]);
  return domain == Domain::Rectangle ? rectanglePattern(given, cornerFix ? 1 : 0)
                                     : trianglePattern(given, cornerFix ? 1 : 0);
}

/// Parameters of a vertex; for a triangle, w = 1 - u - v.
inline glm::dvec2 parametersOf(const PatternPlan& plan, int slot) {
  const ivec4 sample = patternSample(plan, slot);
  return plan.rectangle == 1 ? glm::dvec2(double(sample.x) / sample.y, double(sample.z) / sample.w)
                             : glm::dvec2(sample.x, sample.y) / double(sample.w);
}

inline constexpr uint32_t kRestartIndex = 0xffffffffU;

/// Vertex slots as they are drawn: triangle strips, each ended by kRestartIndex.
inline std::vector<uint32_t> patternIndices(const PatternPlan& plan) {
  std::vector<uint32_t> out;
  out.reserve(static_cast<size_t>(plan.indices));
  for (int slot = 0; slot < plan.indices; ++slot)
    out.push_back(static_cast<uint32_t>(patternIndex(plan, slot)));
  return out;
}

/// Triangles of strips that kRestartIndex separates, all turned as the first of its strip.
inline std::vector<glm::uvec3> stripTriangles(const std::vector<uint32_t>& indices) {
  std::vector<glm::uvec3> out;
  size_t first = 0;
  for (size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] == kRestartIndex) {
      first = i + 1;
    } else if (i - first >= 2) {
      const bool turned = (i - first) % 2 == 1;
      out.emplace_back(indices[turned ? i - 1 : i - 2], indices[turned ? i - 2 : i - 1], indices[i]);
    }
  }
  return out;
}

}  // namespace limen::surfaces
