// SPDX-License-Identifier: BSD-3-Clause
// The binary radix tree over sorted triangles and its boxes, bottom up in one dispatch (Apetrei 2014; the tree is that of
// Karras 2012). Equal codes are told apart by their places. Inner node i parts the sorted triangles i and i + 1.
#include "renderer/ray_tracing/tree_triangles.glsl"

layout(local_size_x = kTreeGroup) in;
layout(std430, binding = kTreeControlBuffer) buffer Control { TreeControl control; };
layout(std430, binding = kTreeKeysBuffer) readonly buffer Keys { uvec2 keys[]; };
layout(std430, binding = kTreeOrderBuffer) readonly buffer Order { uint order[]; };
layout(std430, binding = kTreeNodesBuffer) coherent buffer Nodes { BinaryNode nodes[]; };
layout(std430, binding = kTreeRangesBuffer) coherent buffer Ranges { uint ranges[]; };  // kTreeNone at first

uniform uint triangleCount;  // room for inner nodes

// How much the sorted triangles i and i + 1 differ.
uvec3 difference(uint i) {
  const uvec2 a = keys[i], b = keys[i + 1u];
  return a == b ? uvec3(0u, 0u, i ^ (i + 1u)) : uvec3(a.y ^ b.y, a.x ^ b.x, 0u);
}

bool isLess(uvec3 a, uvec3 b) {
  return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

void main() {
  const uint leaf = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * uint(kTreeGroup) +
                    gl_LocalInvocationIndex;
  const uint valid = control.valid;
  if (leaf >= valid) return;
  const uvec3 t = treeTriangle(order[leaf]);
  TreeBox box = treeBox(treeVertex(t.x), treeVertex(t.y), treeVertex(t.z));
  uint me = triangleCount + leaf, first = leaf, last = leaf, height = 0u;
  nodes[me].low = box.low;
  nodes[me].high = box.high;
  nodes[me].first = leaf;
  nodes[me].count = 1u;
  nodes[me].height = 0u;
  // Each step joins with the neighbour that differs less.
  while (first > 0u || last + 1u < valid) {
    const bool isLeft = first == 0u || (last + 1u < valid && isLess(difference(last), difference(first - 1u)));
    const uint parent = isLeft ? last : first - 1u;
    if (isLeft) nodes[parent].left = me;
    else nodes[parent].right = me;
    memoryBarrierBuffer();
    const uint other = atomicExchange(ranges[parent], isLeft ? first : last);
    if (other == kTreeNone) return;  // the sibling goes on
    memoryBarrierBuffer();
    const uint sibling = isLeft ? nodes[parent].right : nodes[parent].left;
    if (isLeft) last = other;
    else first = other;
    box.low = min(box.low, nodes[sibling].low);
    box.high = max(box.high, nodes[sibling].high);
    height = max(height, nodes[sibling].height);
    me = parent;
    const uint count = last - first + 1u;
    if (count > kTreeMostLeaf) ++height;
    nodes[me].low = box.low;
    nodes[me].high = box.high;
    nodes[me].first = first;
    nodes[me].count = count;
    nodes[me].height = height;
  }
  control.root = me;
}
