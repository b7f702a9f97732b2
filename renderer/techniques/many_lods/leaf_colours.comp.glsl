// SPDX-License-Identifier: BSD-3-Clause
// Light of the surface at the points of a tree, towards the camera. LINKED: samples are those of all nodes of a tree that is not
// complete.
#include "renderer/many_lods/many_lods_bindings.h"
#include "renderer/techniques/many_lods/many_lods_pass_bindings.h"

layout(local_size_x = kLeafColoursGroup) in;
layout(std430, binding = kLeafSamplesBuffer) readonly buffer Samples { uvec2 samples[]; };
layout(std430, binding = kLeafColoursBuffer) writeonly buffer Colours { uvec2 colours[]; };

uniform ivec2 sizePx;
uniform uint leaves;
#include "renderer/frame/shading.glsl"

#ifdef LIT
float sunShare(ivec2 pixel, SeenPoint seen) { return 1.0; }
#endif

void main() {
  const uint leaf = gl_GlobalInvocationID.x;
  if (leaf >= leaves) return;
  const uvec2 at = samples[leaf];
#ifdef LINKED
  if (at.x == kNoTriangle) return;
  const uint node = leaf;
#else
  const uint node = leaves + leaf;
#endif
  const float s = float(at.y & 0xffffu) / 65535.0, t = float(at.y >> 16u) / 65535.0;
  const vec3 weights = vec3(1.0 - s - t, s, t);
  const uvec3 corners = sceneTriangle(at.x);
  const vec3 position =
      weights.x * scenePosition(corners.x) + weights.y * scenePosition(corners.y) + weights.z * scenePosition(corners.z);
  const vec3 away = position - eye;
  const vec3 direction = dot(away, away) > 0.0 ? normalize(away) : vec3(0.0, 0.0, -1.0);
  const vec3 colour = min(pointColour(surfaceHit(at.x, weights, direction), 1.0), vec3(65504.0));
  colours[node] = uvec2(packHalf2x16(colour.xy), packHalf2x16(vec2(colour.z, 1.0)));
}
