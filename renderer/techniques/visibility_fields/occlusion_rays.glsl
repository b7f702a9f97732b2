// SPDX-License-Identifier: BSD-3-Clause
// The rays of a pixel for ambient occlusion, the same for fields and for tracers, and what their distances mean. Set up by
// OcclusionRays::configure().
#include "renderer/techniques/visibility_fields/field_receiver.glsl"

uniform int raySide, turned, falloff;
uniform uint seed;
uniform float falloffRadius;

// Axes across the receiver's normal, turned from pixel to pixel if so chosen.
struct OcclusionFrame {
  vec3 x, y, z;
  vec2 within;  // a cell of the rays
};
OcclusionFrame occlusionFrame(ivec2 pixel, FieldReceiver receiver) {
  const vec3 x = fieldTangent(receiver.normal), y = fieldBitangent(receiver.normal);
  const float angle = turned == 0 ? 0.0 : 2.0 * kFieldPi * pixelPlace(pixel, 0u, seed).x;
  return OcclusionFrame(cos(angle) * x + sin(angle) * y, cos(angle) * y - sin(angle) * x, receiver.normal, placeInCell(pixel));
}

// Directions about z of the first rays, the same for all pixels unless these are interleaved.
const int kRayTableSize = 256;
shared vec3 rayTable[kRayTableSize];
void makeRayTable() {
  const int count = min(raySide * raySide, kRayTableSize);
  for (int i = int(gl_LocalInvocationIndex); i < count; i += kGroupSide * kGroupSide)
    rayTable[i] = fieldDirection((vec2(i % raySide, i / raySide) + 0.5) / float(raySide), kFieldConcentric);
  barrier();
}

// Without the table.
vec3 occlusionWay(OcclusionFrame frame, int ray) {
  const vec3 local = fieldDirection((vec2(ray % raySide, ray / raySide) + frame.within) / float(raySide), kFieldConcentric);
  return normalize(local.x * frame.x + local.y * frame.y + local.z * frame.z);
}

// Spread by the cosine. After makeRayTable().
vec3 occlusionDirection(OcclusionFrame frame, int ray) {
  vec3 local;
  if (interleave == 1 && ray < kRayTableSize) local = rayTable[ray];
  else local = fieldDirection((vec2(ray % raySide, ray / raySide) + frame.within) / float(raySide), kFieldConcentric);
  return normalize(local.x * frame.x + local.y * frame.y + local.z * frame.z);
}

// Share of light that a surface at this distance lets through.
float visibilityAt(float distance) {
  if (falloff == kFalloffBinary) return distance > falloffRadius ? 1.0 : 0.0;
  const float relative = distance / falloffRadius;
  return falloff == kFalloffLinear ? min(1.0, relative) : 1.0 - exp(-relative);
}
