// SPDX-License-Identifier: BSD-3-Clause
// Light of the node that a pixel of an atlas holds (FORM: of the atlas; lit_points.h).
#include "renderer/many_lods/cones.glsl"
#include "renderer/many_lods/many_lods_bindings.h"
#include "renderer/techniques/many_lods/many_lods_pass_bindings.h"

layout(std430, binding = kGatherDepthsBuffer) readonly buffer Depths { uint depths[]; };
#if FORM == 1
layout(std430, binding = kGatherWinnersBuffer) readonly buffer Winners { uint winners[]; };
#endif
layout(std430, binding = kGatherColoursBuffer) readonly buffer Colours { uvec2 colours[]; };
layout(std430, binding = kGatherConesBuffer) readonly buffer NodeCones { uvec2 nodeCones[]; };

// Back along the unit vector `towards`.
vec3 heldBy(uint at, vec3 towards) {
#if FORM == 1
  if (depths[at] == kAtlasEmpty || winners[at] == kAtlasEmpty) return vec3(0.0);
  const uint node = winners[at];
#else
  if (depths[2u * at + 1u] == kAtlasEmpty) return vec3(0.0);
  const uint node = depths[2u * at];
#endif
  const uvec2 halves = colours[node];
  const vec2 rest = unpackHalf2x16(halves.y);
  const vec3 light = vec3(unpackHalf2x16(halves.x), rest.x);
  const float mean = (light.r + light.g + light.b) / 3.0;
  const uvec2 cone = nodeCones[node];
  // Points that face all ways have no sides.
  if (!(mean > 0.0) || coneHalfAngle(cone) > 0.5 * kConePi) return light;
  const float front = clamp(0.5 + 0.5 * rest.y / mean, 0.0, 1.0);
  return light * (dot(coneAxis(cone), towards) < 0.0 ? front : 1.0 - front);
}
