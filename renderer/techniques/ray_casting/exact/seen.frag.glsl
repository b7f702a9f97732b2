// SPDX-License-Identifier: BSD-3-Clause
// What was found on the CPU, as surface.frag.glsl of tessellation writes it. See exact.cpp.
#include "renderer/techniques/ray_casting/ray_casting_bindings.h"

layout(binding = kSeenIdsUnit) uniform usampler2D seenIds;
layout(binding = kSeenNormalsUnit) uniform sampler2D seenNormals;  // and distance along the view; 0: nothing
layout(location = 0) out uint id;
layout(location = 1) out vec4 normalAndDistance;
uniform float nearest;

void main() {
  const ivec2 pixel = ivec2(gl_FragCoord.xy);
  const vec4 seen = texelFetch(seenNormals, pixel, 0);
  if (!(seen.w > 0.0)) discard;
  id = texelFetch(seenIds, pixel, 0).x;
  normalAndDistance = seen;
  gl_FragDepth = nearest / seen.w;
}
