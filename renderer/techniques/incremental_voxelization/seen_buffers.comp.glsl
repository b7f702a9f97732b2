// SPDX-License-Identifier: BSD-3-Clause
// Normal and light of what each pixel of a view sees, and in the fourth channel of the light the share of a voxel's side squared
// that the surface in a cell of the grid of points has: the weight of a sample of the light's.
#include "renderer/techniques/incremental_voxelization/point_raster_bindings.h"
#include "renderer/incremental_voxels/seen_surface.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kSeenNormalImage, rgba16f) uniform writeonly image2D normalImage;
layout(binding = kSeenLightImage, rgba32f) uniform writeonly image2D lightImage;
uniform int seenView, pointsPerSide;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, viewSizePx[seenView]))) return;
  vec4 normal = vec4(0.0), light = vec4(0.0);
  const float depth = depthAt(seenView, pixel);
  if (depth > 0.0) {
    const vec3 ray = viewRay(seenView, pixel), point = viewNear[seenView] / depth * ray;
    const SeenSurface surface = surfaceOf(seenView, pixel, (voxelsFromView[seenView] * vec4(point, 1.0)).xyz);
    normal = vec4(surface.normal, 1.0);
    const float facing = abs(dot(normalize(mat3(viewFromVoxels[seenView]) * surface.normal), ray));
    const vec2 cell = viewExtent[seenView] * point.z / (float(pointsPerSide) * voxelSize);
    light = vec4(surface.light, cell.x * cell.y / max(facing, 0.01));
  }
  imageStore(normalImage, pixel, normal);
  imageStore(lightImage, pixel, light);
}
