// SPDX-License-Identifier: BSD-3-Clause
// Rays from the eye through the pixels' centres.
uniform ivec2 sizePx;
#include "renderer/frame/seen_point.glsl"
#include "renderer/techniques/reflections/ray_hierarchy/ray_hierarchy_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kHierarchyNextOriginsImage, rgba32f) uniform writeonly image2D nextOrigins;
layout(binding = kHierarchyNextDirectionsImage, rgba32f) uniform writeonly image2D nextDirections;
layout(binding = kHierarchyNextFromImage, r32ui) uniform writeonly uimage2D nextFrom;
uniform mat4 cameraToAnchor;
uniform vec2 rayScale;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  imageStore(nextOrigins, pixel, vec4(cameraToAnchor[3].xyz, 1.0));
  imageStore(nextDirections, pixel, vec4(normalize(mat3(cameraToAnchor) * pixelRay(pixel, rayScale, sizePx)), 0.0));
  imageStore(nextFrom, pixel, uvec4(kHierarchyNoTriangle));
}
