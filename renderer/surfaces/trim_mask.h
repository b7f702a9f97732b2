// SPDX-License-Identifier: BSD-3-Clause
// Trimmed surfaces: what is left of a parameter domain inside closed curves (Schwarz 2009, section 6.1.4;
// SC-18).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace limen::surfaces {

/// Closed curves in the unit square as polygons. A place is left if it lies inside an odd number of them.
struct TrimRegion {
  std::vector<std::vector<glm::dvec2>> loops;
  bool contains(glm::dvec2 at) const;
  double area() const;  ///< between the polygons; loops must not cross one another
};

/// Polygon of a closed chain of Bézier curves, rational if weights (z) differ: homogeneous (w x, w y, w).
/// Each ends where the next begins; `segments` of each.
std::vector<glm::dvec2> trimLoop(std::span<const std::vector<glm::dvec3>> curves, int segments);

/// What a texture over the domain holds.
enum class TrimTexture {
  Inside,   ///< 1 where the texel's middle is left
  Distance  ///< signed distance to the nearest curve, positive where the surface is left; interpolated
};

/// A region sampled by a square texture, as a shader reads it.
class TrimMask {
 public:
  TrimMask(const TrimRegion& region, int resolution, TrimTexture texture);
  bool contains(glm::dvec2 at) const;
  int64_t bytes() const {
    return static_cast<int64_t>(texels_.size()) * (texture_ == TrimTexture::Inside ? 1 : 2);
  }

 private:
  float texel(int x, int y) const;
  int resolution_;
  TrimTexture texture_;
  std::vector<float> texels_;
};

/// Share of the domain where the mask says otherwise than the region, from `samples` x `samples` places.
double trimError(const TrimRegion& region, const TrimMask& mask, int samples);

}  // namespace limen::surfaces
