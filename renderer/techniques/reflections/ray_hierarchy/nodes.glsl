// SPDX-License-Identifier: BSD-3-Clause
// The hierarchy in memory: levels one after another from the rays upwards, each by rows. Level l has a node for each
// block of 2^l x 2^l rays.
#include "renderer/techniques/reflections/ray_hierarchy/cone_sphere.glsl"

#ifndef NODES_ACCESS
#define NODES_ACCESS readonly
#endif
layout(std430, binding = kHierarchyNodesBuffer) NODES_ACCESS buffer Nodes { vec4 nodes[]; };  // 2 a node
uniform uint levelFirst[kHierarchyLevels];

ivec2 levelSize(uint level) { return (sizePx + (1 << level) - 1) >> level; }
uint nodeIndex(uint level, ivec2 at) { return levelFirst[level] + uint(at.y * levelSize(level).x + at.x); }
ConeSphere nodeAt(uint level, ivec2 at) {
  const uint index = 2u * nodeIndex(level, at);
  const vec4 ball = nodes[index], cone = nodes[index + 1u];
  return ConeSphere(ball.xyz, ball.w, cone.xyz, cone.w);
}
