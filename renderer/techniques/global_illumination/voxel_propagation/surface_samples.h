// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/scene.h"

namespace limen::techniques {

/// A point of a triangle that stands for a part of its area.
struct SurfaceSample {
  uint32_t triangle = 0;
  float u = 0.0F, v = 0.0F;  ///< barycentric coordinates of the second and third corner
  double area = 0.0;         ///< world units squared
};

/// Points on all triangles of finite area: each is cut into rows parallel to its longest side, at most
/// `spacing` high, and these across into slices of equal length, which is at most `spacing` of a row's width
/// at half its height. Each is one sample at its centre of mass with its area, so that areas of a triangle's
/// samples sum to its own, and their centre is its own, however slender it is. At most `mostSamples` in all:
/// a wider spacing is taken where more were needed.
std::vector<SurfaceSample> sampleSurfaces(const scene::Scene& scene, double spacing, size_t mostSamples);

/// The same as texels of an RGBA32UI texture: triangle, the two coordinates and the area over `unitArea`, of
/// which the last three are floats' bits. At most 4 M samples.
struct SampleTexture {
  glm::ivec2 sizePx{1};
  uint32_t count = 0;
  std::vector<uint32_t> texels;
};
SampleTexture sampleTexture(const scene::Scene& scene, double spacing, double unitArea);

}  // namespace limen::techniques
