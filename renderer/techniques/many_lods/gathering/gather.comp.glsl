// SPDX-License-Identifier: BSD-3-Clause
// A group a view: the mean over the hemisphere, by the cosine, of what its pixels hold. LIGHT: the light of nodes (FORM: of the
// atlas); else 1 where nothing is within the radius.
#include "renderer/many_lods/many_lods_bindings.h"
#include "renderer/techniques/many_lods/many_lods_pass_bindings.h"

layout(local_size_x = kGatherGroup) in;
layout(std430, binding = kGatherDepthsBuffer) readonly buffer Depths { uint depths[]; };
#ifdef LIGHT
#if FORM == 1
layout(std430, binding = kGatherWinnersBuffer) readonly buffer Winners { uint winners[]; };
#endif
layout(std430, binding = kGatherColoursBuffer) readonly buffer Colours { uvec2 colours[]; };
#endif
layout(std430, binding = kGatheredBuffer) writeonly buffer Gathered { vec4 gathered[]; };

uniform int side;
uniform float farthest;  // depth beyond which nothing occludes
uniform uint viewCount;

shared vec4 line[kGatherGroup];

vec3 heldBy(uint at) {
#ifdef LIGHT
#if FORM == 1
  if (depths[at] == kAtlasEmpty) return vec3(0.0);
  const uvec2 halves = colours[winners[at]];
#else
  if (depths[2u * at + 1u] == kAtlasEmpty) return vec3(0.0);
  const uvec2 halves = colours[depths[2u * at]];
#endif
  return vec3(unpackHalf2x16(halves.x), unpackHalf2x16(halves.y).x);
#else
  return vec3(depths[at] == kAtlasEmpty || uintBitsToFloat(depths[at]) > farthest ? 1.0 : 0.0);
#endif
}

void main() {
  const int me = int(gl_LocalInvocationIndex);
  for (uint view = gl_WorkGroupID.x; view < viewCount; view += gl_NumWorkGroups.x) {
    vec4 sum = vec4(0.0);
    for (int pixel = me; pixel < side * side; pixel += kGatherGroup) {
      const vec2 at = 2.0 * (vec2(pixel % side, pixel / side) + 0.5) / float(side) - 1.0;
      const float square = dot(at, at);
      if (square >= 1.0) continue;
      // Of a stereographic pixel: cosine (1 - s) / (1 + s), solid angle in proportion to 1 / (1 + s)^2.
      const float weight = (1.0 - square) / ((1.0 + square) * (1.0 + square) * (1.0 + square));
      sum += weight * vec4(heldBy(view * uint(side * side) + uint(pixel)), 1.0);
    }
    barrier();
    line[me] = sum;
    barrier();
    for (int half_ = kGatherGroup / 2; half_ > 0; half_ /= 2) {
      if (me < half_) line[me] += line[me + half_];
      barrier();
    }
    if (me == 0) gathered[view] = vec4(line[0].rgb / line[0].a, 1.0);
  }
}
