// SPDX-License-Identifier: BSD-3-Clause
// The triangles that a tree is built over. Vertices are tightly packed.
#include "renderer/ray_tracing/rebuilt_tree_bindings.h"

layout(std430, binding = kTreePositionsBuffer) readonly buffer Positions { float treePositions[]; };
layout(std430, binding = kTreeIndicesBuffer) readonly buffer Indices { uint treeIndices[]; };

vec3 treeVertex(uint vertex) {
  return vec3(treePositions[3u * vertex], treePositions[3u * vertex + 1u], treePositions[3u * vertex + 2u]);
}

uvec3 treeTriangle(uint triangle) {
  return uvec3(treeIndices[3u * triangle], treeIndices[3u * triangle + 1u], treeIndices[3u * triangle + 2u]);
}

struct TreeBox {
  vec3 low, high;
};

TreeBox treeBox(vec3 a, vec3 b, vec3 c) { return TreeBox(min(a, min(b, c)), max(a, max(b, c))); }

// Half of each coordinate, so that no sum overflows.
vec3 treeCentre(TreeBox box) { return 0.5 * box.low + 0.5 * box.high; }

bool treeIsFinite(vec3 v) {
  return all(notEqual(floatBitsToUint(v) & 0x7f800000u, uvec3(0x7f800000u)));
}

// Whether it has an area and finite coordinates.
bool treeIsValid(vec3 a, vec3 b, vec3 c) {
  if (!treeIsFinite(a) || !treeIsFinite(b) || !treeIsFinite(c)) return false;
  const dvec3 e = dvec3(b) - dvec3(a), f = dvec3(c) - dvec3(a);
  precise const dvec3 left = e.yzx * f.zxy, right = f.yzx * e.zxy;
  return any(notEqual(left, right));
}
