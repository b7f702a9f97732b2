// SPDX-License-Identifier: BSD-3-Clause
// Spheres of the tree from the leaves up, several levels a dispatch: a group makes everything between 512 leaves, or nodes of a
// level, and their common ancestor. LEAVES: of leaves, from the triangles where they are now. CONES: cones as well. TRAVEL: and how
// far they move. Twins: mergedSphere(), merged() and pack() in sphere_tree.cpp.
#include "renderer/many_lods/many_lods_bindings.h"

layout(local_size_x = kUpdateGroup) in;
layout(std430, binding = kUpdateNodesBuffer) buffer Nodes { vec4 nodes[]; };
#ifdef CONES
layout(std430, binding = kUpdateConesBuffer) buffer Cones { uvec2 cones[]; };
#endif
#include "renderer/many_lods/tree_nodes.glsl"

uniform uint first;        // node: of the level that is merged; as many nodes as its number

const uint kInputs = 2u * uint(kUpdateGroup);
shared vec4 line[kUpdateGroup];
#ifdef CONES
#include "renderer/many_lods/cones.glsl"
shared uvec2 coneLine[kUpdateGroup];
#endif

#ifdef TRAVEL
layout(std430, binding = kUpdateTravelBuffer) buffer Travel { TreeTravel travel; };
shared uint centreHere, radiusHere;
vec2 moved = vec2(0.0);
#endif

void put(uint node, vec4 sphere) {
#ifdef TRAVEL
  const vec4 before = nodes[node];
  moved = max(moved, vec2(distance(before.xyz, sphere.xyz), abs(before.w - sphere.w)));
#endif
  nodes[node] = sphere;
}

#ifdef TRAVEL
// By all of the group, at the end. The last dispatch has one group, and adds up.
void travelOn() {
  if (gl_LocalInvocationIndex == 0u) centreHere = radiusHere = 0u;
  barrier();
  if (moved != vec2(0.0)) {
    atomicMax(centreHere, floatBitsToUint(moved.x));
    atomicMax(radiusHere, floatBitsToUint(moved.y));
  }
  barrier();
  if (gl_LocalInvocationIndex > 0u) return;
  if (gl_NumWorkGroups.x > 1u) {
    if (centreHere > 0u) atomicMax(travel.centreNow, centreHere);
    if (radiusHere > 0u) atomicMax(travel.radiusNow, radiusHere);
    return;
  }
  travel.centres += double(uintBitsToFloat(max(centreHere, travel.centreNow)));
  travel.radii += double(uintBitsToFloat(max(radiusHere, travel.radiusNow)));
  travel.centreNow = travel.radiusNow = 0u;
}
#endif

void main() {
  const uint me = gl_LocalInvocationIndex;
  const uint at = gl_WorkGroupID.x * kInputs + 2u * me;  // of the two that this invocation merges
  vec4 own = vec4(0.0);
#ifdef CONES
  uvec2 cone = uvec2(0u);
#endif
  if (at < first) {
#ifdef LEAVES
    vec3 normalA, normalB;
    const vec4 a = leafOf(at, normalA), b = leafOf(at + 1u, normalB);
    put(first + at, a);
    put(first + at + 1u, b);
#ifdef CONES
    const uvec2 coneA = packedCone(unitOr(normalA), 0.0), coneB = packedCone(unitOr(normalB), 0.0);
    cones[first + at] = coneA;
    cones[first + at + 1u] = coneB;
    cone = mergedCone(coneA, coneB);
#endif
#else
    const vec4 a = nodes[first + at], b = nodes[first + at + 1u];
#ifdef CONES
    cone = mergedCone(cones[first + at], cones[first + at + 1u]);
#endif
#endif
    own = mergedSphere(a, b);
  }
  uint level = first >> 1u, width = uint(kUpdateGroup);
  while (true) {
    const uint here = gl_WorkGroupID.x * width + me;
    if (me < width && here < level) {
      put(level + here, own);
#ifdef CONES
      cones[level + here] = cone;
#endif
    }
    if (level <= 1u || width == 1u) break;
    barrier();
    line[me] = own;
#ifdef CONES
    coneLine[me] = cone;
#endif
    barrier();
    level >>= 1u;
    width >>= 1u;
    if (me < width) {
      own = mergedSphere(line[2u * me], line[2u * me + 1u]);
#ifdef CONES
      cone = mergedCone(coneLine[2u * me], coneLine[2u * me + 1u]);
#endif
    }
  }
#ifdef TRAVEL
  travelOn();
#endif
}
