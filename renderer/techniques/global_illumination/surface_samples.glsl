// SPDX-License-Identifier: BSD-3-Clause
// A sample of the surfaces for each invocation (voxel_propagation/surface_samples.h), whose light is added to voxels. The including
// shader defines addSide(), which each side of a surface that may send light is handed to; with DARK_SIDES every side.
#include "renderer/techniques/global_illumination/illumination_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kInjectSamplesUnit) uniform usampler2D samples;  // triangle, two weights, area over a face's

uniform ivec2 sizePx;
uniform uint sampleCount;
#include "renderer/techniques/global_illumination/surface_light.glsl"

float chance = 0.0;  // of the sample, in [0, 1)

// A share of a sum in whole units, in the mean exact: of many small samples none would be left if each were rounded to the nearest.
int wholeUnits(float value) { return int(floor(kInjectFixed * value + chance)); }

// By the surface's normal, of any length.
bool takesSample(vec3 front);
void addSide(SurfacePoint point, vec3 albedo, float area);

void main() {
  const uint index = gl_GlobalInvocationID.y * uint(textureSize(samples, 0).x) + gl_GlobalInvocationID.x;
  if (gl_GlobalInvocationID.x >= uint(textureSize(samples, 0).x) || index >= sampleCount) return;
  const uvec4 texel = texelFetch(samples, ivec2(gl_GlobalInvocationID.xy), 0);
  const vec2 uv = uintBitsToFloat(texel.yz);
  // Multiples of the golden ratio: neighbours' chances are spread evenly.
  chance = float(index * 0x9e3779b9u >> 8) / 16777216.0;
  const vec3 weights = vec3(1.0 - uv.x - uv.y, uv);
  const uvec3 vertices = sceneTriangle(texel.x);
  const vec3 a = scenePosition(vertices.x), e1 = scenePosition(vertices.y) - a, e2 = scenePosition(vertices.z) - a;
  // Scaled before the product: squares of a tiny scene's areas would leave float's range.
  const vec3 reach = max(abs(e1), abs(e2));
  const float unit = 1.0 / max(reach.x, max(reach.y, reach.z));
  const vec3 front = cross(e1 * unit, e2 * unit);
  if (!(dot(front, front) > 0.0) || !takesSample(front)) return;
  SurfacePoint point = surfaceHit(texel.x, weights, -normalize(front));
  const vec3 albedo = reflectance(point);
#ifdef DARK_SIDES
  uint sides = 3u;
#else
  uint sides = emitted(point) != vec3(0.0) ? 1u : 0u;
#ifdef LIT
  const float facing = dot(lightPosition - point.position, point.flatNormal);
  if (facing > 0.0) sides |= 1u;
  if (facing < 0.0) sides |= 2u;
#endif
#endif
  // Not unrolled, so that what a side does stands in the shader once.
  for (; sides != 0u; sides &= sides - 1u) {
    if ((sides & 1u) == 0u) point = surfaceHit(texel.x, weights, normalize(front));
    addSide(point, albedo, uintBitsToFloat(texel.w));
  }
}
