// SPDX-License-Identifier: BSD-3-Clause
// Hierarchy over rays: a group merges 16 x 16 nodes, or rays, up to one, four levels in shared memory.
#define NODES_ACCESS
uniform ivec2 sizePx;
#include "renderer/techniques/reflections/ray_hierarchy/nodes.glsl"

layout(local_size_x = kBuildSide, local_size_y = kBuildSide) in;
layout(binding = kHierarchyOriginsUnit) uniform sampler2D origins;
layout(binding = kHierarchyDirectionsUnit) uniform sampler2D directions;
layout(std430, binding = kHierarchyHitsBuffer) writeonly buffer Hits { uvec2 hits[]; };
uniform bool clears;     // the rays' hits
uniform bool reversed;   // rays that end at the light, as rays from there
uniform vec3 lightAt;    // relative to the anchor
uniform uint fromLevel;  // 0: rays
uniform uint lastLevel;

shared vec4 balls[kBuildSide * kBuildSide], cones[kBuildSide * kBuildSide];

void store(uint level, ivec2 at, ConeSphere node) {
  const uint index = 2u * nodeIndex(level, at);
  nodes[index] = vec4(node.centre, node.radius);
  nodes[index + 1u] = vec4(node.axis, node.spread);
}

void main() {
  const ivec2 at = ivec2(gl_GlobalInvocationID.xy), me = ivec2(gl_LocalInvocationID.xy);
  ConeSphere node = kNoRays;
  if (all(lessThan(at, levelSize(fromLevel)))) {
    if (fromLevel == 0u) {
      const vec4 origin = texelFetch(origins, at, 0);
      // Written so that a NaN is no ray.
      if (origin.w > 0.0 && all(lessThan(abs(origin.xyz), vec3(3.0e38))))
#ifdef CONES
        node = coneNode(origin, texelFetch(directions, at, 0));
#else
        node = rayNode(reversed ? lightAt : origin.xyz,
                       reversed ? -texelFetch(directions, at, 0).xyz : texelFetch(directions, at, 0).xyz);
#endif
      store(0u, at, node);
      if (clears) hits[at.y * sizePx.x + at.x] = uvec2(kFarthestBits, kHierarchyNoTriangle);
    } else {
      node = nodeAt(fromLevel, at);
    }
  }
  balls[gl_LocalInvocationIndex] = vec4(node.centre, node.radius);
  cones[gl_LocalInvocationIndex] = vec4(node.axis, node.spread);
  for (int level = 1; level <= kBuildLevels; ++level) {
    barrier();
    const int step_ = 1 << level;
    if (all(equal(me & (step_ - 1), ivec2(0)))) {
      ConeSphere parts[4];
      for (int i = 0; i < 4; ++i) {
        const ivec2 from = me + ivec2(i & 1, i >> 1) * (step_ >> 1);
        const int index = from.y * kBuildSide + from.x;
        parts[i] = ConeSphere(balls[index].xyz, balls[index].w, cones[index].xyz, cones[index].w);
      }
      node = merged(parts);
      const uint above = fromLevel + uint(level);
      const ivec2 place = at >> level;
      if (above <= lastLevel && all(lessThan(place, levelSize(above)))) store(above, place, node);
    }
    barrier();
    if (all(equal(me & (step_ - 1), ivec2(0)))) {
      balls[gl_LocalInvocationIndex] = vec4(node.centre, node.radius);
      cones[gl_LocalInvocationIndex] = vec4(node.axis, node.spread);
    }
  }
}
