// SPDX-License-Identifier: BSD-3-Clause
// Bias and height of the shadow map's texels by the plane of the triangle that each sees. Schwarz 2009, section 4.5.4, where
// the function of the slope is left open.
//
// On the plane n.q = d the ray along (u, v, 1) has depth z = d / n.(u, v, 1). From a texel's centre to a corner n.(u, v, 1)
// changes by the fraction e = (|n_x| du + |n_y| dv) / (2 |n.(u, v, 1)|) at most, and depth from z to z / (1 - e).
#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/scene_buffers.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kSlopeBiasIdsUnit) uniform usampler2D triangleIds;
layout(binding = kSlopeBiasMinimumMapUnit) uniform sampler2D minimumMap;
layout(binding = kSlopeBiasImage, rg32f) uniform writeonly image2D outBiases;
uniform mat4 anchorToLight;
uniform vec2 tangentLow, tangentSize;
uniform int resolution;
uniform float maxSlope;

const uint kNone = 0xffffffffu;
// Texels so coarse that the plane passes the eye within them have no such corner; depth is doubled at most.
const float kLargestShare = 0.5;

vec3 lightPosition(uint vertex) { return (anchorToLight * vec4(scenePosition(vertex), 1.0)).xyz; }

void main() {
  const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, ivec2(resolution)))) return;
  const uint id = texelFetch(triangleIds, texel, 0).x;
  float bias = 0.0;
  if (id != kNone) {
    const uvec3 vertices = sceneTriangle(id);
    const vec3 a = lightPosition(vertices.x), e1 = lightPosition(vertices.y) - a, e2 = lightPosition(vertices.z) - a;
    // Scaled before the product: squares of a tiny scene's areas would leave float's range.
    const vec3 reach = max(abs(e1), abs(e2));
    const float unit = 1.0 / max(reach.x, max(reach.y, reach.z));
    const vec3 n = cross(e1 * unit, e2 * unit);
    const vec2 size = tangentSize / float(resolution);
    const vec2 tangent = tangentLow + (vec2(texel) + 0.5) * size;
    const float change = abs(n.x) * size.x + abs(n.y) * size.y, along = abs(dot(n, vec3(tangent, 1.0)));
    // Compared before it is divided: an edge-on triangle has no slope.
    const float limit = maxSlope * max(size.x, size.y);
    const float share = min(0.5 * (change < limit * along ? change / along : limit), kLargestShare);
    bias = texelFetch(minimumMap, texel, 0).x * share / (1.0 - share);
  }
  imageStore(outBiases, texel, vec4(bias, bias, 0.0, 0.0));
}
