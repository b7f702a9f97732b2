// SPDX-License-Identifier: BSD-3-Clause
// The box of the triangles' centres, and how many triangles belong into the tree.
#include "renderer/ray_tracing/tree_triangles.glsl"

layout(local_size_x = kTreeGroup) in;
layout(std430, binding = kTreeControlBuffer) buffer Control { TreeControl control; };

uniform uint triangleCount;

shared uint groupHigh[3], groupLow[3], groupValid;

// In the order of the numbers.
uint ordered(float value) {
  const uint bits = floatBitsToUint(value);
  return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}

void main() {
  if (gl_LocalInvocationIndex == 0u) {
    groupValid = 0u;
    for (int axis = 0; axis < 3; ++axis) groupHigh[axis] = groupLow[axis] = 0u;
  }
  barrier();
  const uint triangle = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * uint(kTreeGroup) +
                        gl_LocalInvocationIndex;
  if (triangle < triangleCount) {
    const uvec3 t = treeTriangle(triangle);
    const vec3 a = treeVertex(t.x), b = treeVertex(t.y), c = treeVertex(t.z);
    if (treeIsValid(a, b, c)) {
      const vec3 centre = treeCentre(treeBox(a, b, c));
      for (int axis = 0; axis < 3; ++axis) {
        const uint word = ordered(centre[axis]);
        atomicMax(groupHigh[axis], word);
        atomicMax(groupLow[axis], ~word);
      }
      atomicAdd(groupValid, 1u);
    }
  }
  barrier();
  if (gl_LocalInvocationIndex != 0u || groupValid == 0u) return;
  for (int axis = 0; axis < 3; ++axis) {
    atomicMax(control.high[axis], groupHigh[axis]);
    atomicMax(control.low[axis], groupLow[axis]);
  }
  atomicAdd(control.valid, groupValid);
}
