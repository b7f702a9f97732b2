// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace limen::many_lods {

/// A point of a surface by its place in a triangle, so that it follows when the triangle deforms: position
/// (1 - s - t) a + s b + t c. 8 bytes, as the GPU has it.
struct SurfaceSample {
  uint32_t triangle = 0;
  uint32_t place = 0;  ///< s and t in 1/65535, in the lower and the upper half; s + t <= 1

  double s() const { return (place & 0xffffU) / 65535.0; }
  double t() const { return (place >> 16) / 65535.0; }
};
static_assert(sizeof(SurfaceSample) == 8);

/// `count` points of the triangles, uniform by area: of every run of triangles in order the number of points
/// differs from its share of the area by less than 1 at either end, and within a triangle they follow a
/// sequence of low discrepancy. Triangles without area, or with one that is not finite, get none. The same
/// seed gives the same points. Throws Error if no triangle has an area. Source: Holländer 2013,
/// section 3.4.1 ("uniformly"); strata and sequence (R2, Roberts 2018) are the bench's own.
std::vector<SurfaceSample> sampleSurface(const std::vector<glm::dvec3>& positions,
                                         const std::vector<glm::uvec3>& triangles, uint32_t count,
                                         uint64_t seed);

/// Where a sample lies.
glm::dvec3 positionOf(const SurfaceSample& sample, const std::vector<glm::dvec3>& positions,
                      const std::vector<glm::uvec3>& triangles);

/// Sum of the triangles' areas, as far as they are finite.
double surfaceArea(const std::vector<glm::dvec3>& positions, const std::vector<glm::uvec3>& triangles);

}  // namespace limen::many_lods
