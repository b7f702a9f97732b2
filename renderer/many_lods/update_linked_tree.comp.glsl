// SPDX-License-Identifier: BSD-3-Clause
// Spheres of one level of a tree that is not complete: of its leaves from the triangles where they are now, of its other nodes from
// the level below. CONES: cones as well.
#include "renderer/many_lods/many_lods_bindings.h"

layout(local_size_x = kUpdateGroup) in;
layout(std430, binding = kUpdateNodesBuffer) buffer Nodes { vec4 nodes[]; };
layout(std430, binding = kCutLinksBuffer) readonly buffer Links { TreeLink links[]; };
#ifdef CONES
layout(std430, binding = kUpdateConesBuffer) buffer Cones { uvec2 cones[]; };
#include "renderer/many_lods/cones.glsl"
#endif
#ifndef LEAVES
#define LEAVES 1
#endif
#include "renderer/many_lods/tree_nodes.glsl"

uniform uint first, end;  // nodes of the level

void main() {
  const uint node = first + gl_GlobalInvocationID.x;
  if (node >= end) return;
  const uint child = links[node].firstChild;
  if (child == 0u) {
    vec3 normal;
    nodes[node] = leafOf(node, normal);
#ifdef CONES
    cones[node] = packedCone(unitOr(normal), 0.0);
#endif
    return;
  }
  nodes[node] = mergedSphere(nodes[child], nodes[child + 1u]);
#ifdef CONES
  cones[node] = mergedCone(cones[child], cones[child + 1u]);
#endif
}
