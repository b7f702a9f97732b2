// SPDX-License-Identifier: BSD-3-Clause
// The points of a light that one pixel's rays go to, relative to the anchor: for comparison with LightSamples.
#include "renderer/references/light_point.glsl"

layout(local_size_x = kShadowRayGroup) in;
layout(std430, binding = kShadowRayReceiversBuffer) writeonly buffer Points { double points[]; };  // three a point

uniform uint pixel, endSample;

void main() {
  const uint index = gl_GlobalInvocationID.x;
  if (index >= endSample) return;
  const dvec3 at = lightPoint(pixelBits(pixel), index);
  points[3u * index] = at.x;
  points[3u * index + 1u] = at.y;
  points[3u * index + 2u] = at.z;
}
