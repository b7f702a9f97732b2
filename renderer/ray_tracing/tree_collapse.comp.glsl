// SPDX-License-Identifier: BSD-3-Clause
// The wide tree that rays are traced through (WideNode in wide_bvh.h) from the binary one, a level after the other. A node
// opens the child of the largest surface, as the build on the CPU does. Where the levels that the rays' stack has left
// would not do for that, it opens the highest child: nodes whose height is at most 2 less than the node's are 7 at most,
// all of which are opened, so that each level takes 3 off the height.
//
// ALONE: one group takes levels until there are more than `most` nodes in one; else a dispatch takes one level.
#include "renderer/ray_tracing/ray_tracing_bindings.h"
#include "renderer/ray_tracing/tree_triangles.glsl"

layout(local_size_x = kTreeCollapseGroup) in;
layout(std430, binding = kTreeControlBuffer) coherent buffer Control { TreeControl control; };
layout(std430, binding = kTreeTasksBuffer) coherent buffer Tasks { uint tasks[]; };  // binary node of each wide one
layout(std430, binding = kTreeOrderBuffer) readonly buffer Order { uint order[]; };
layout(std430, binding = kTreeNodesBuffer) readonly buffer Nodes { BinaryNode nodes[]; };
layout(std430, binding = kTreeWideNodesBuffer) writeonly buffer WideNodes { uvec4 wideNodes[]; };  // 5 a node
layout(std430, binding = kTreeWideTrianglesBuffer) writeonly buffer WideTriangles { vec4 wideTriangles[]; };  // 3 each

#ifdef ALONE
uniform bool begins;  // at the root
uniform uint most;
#endif

struct Child {
  vec3 low, high;
  uint node, first, count, height;
};

Child childOf(uint node) {
  const BinaryNode of = nodes[node];
  return Child(of.low, of.high, node, of.first, of.count, of.height);
}

float halfArea(Child child) {
  const vec3 extent = child.high - child.low;
  return extent.x * extent.y + extent.y * extent.z + extent.z * extent.x;
}

// Opens children until there are eight.
uint divide(inout Child children[8], bool byHeight) {
  uint count = 1u;
  while (count < 8u) {
    int best = -1;
    float cost = 0.0;
    uint length_ = 0u;
    // Leaves last, and the longest of what costs the same.
    for (int leaves = 0; leaves < 2 && best < 0; ++leaves)
      for (uint i = 0u; i < count; ++i) {
        const Child child = children[i];
        if (child.count < 2u || (child.count <= kTreeMostLeaf) != (leaves == 1)) continue;
        const float own = leaves == 1 ? halfArea(child) * float(child.count)
                                      : byHeight ? float(child.height) : halfArea(child);
        if (best < 0 || own > cost || (own == cost && child.count > length_)) {
          best = int(i);
          cost = own;
          length_ = child.count;
        }
      }
    if (best < 0) break;
    const BinaryNode opened = nodes[children[best].node];
    children[best] = childOf(opened.left);
    children[count++] = childOf(opened.right);
  }
  return count;
}

// Which child lies in each octant of the node; -1: none. The child that is farthest out chooses first.
void setSlots(Child children[8], uint count, vec3 middle, out int childIn[8]) {
  for (int slot = 0; slot < 8; ++slot) childIn[slot] = -1;
  uint placed = 0u;
  for (uint n = 0u; n < count; ++n) {
    float farthest = 0.0;
    int bestChild = -1, bestSlot = -1;
    for (uint i = 0u; i < count; ++i) {
      if ((placed & 1u << i) != 0u) continue;
      const vec3 from = (0.5 * children[i].low + 0.5 * children[i].high) - middle;
      for (int slot = 0; slot < 8; ++slot) {
        if (childIn[slot] >= 0) continue;
        const float along = ((slot & 4) != 0 ? from.x : -from.x) + ((slot & 2) != 0 ? from.y : -from.y) +
                            ((slot & 1) != 0 ? from.z : -from.z);
        if (bestChild < 0 || along > farthest) {
          farthest = along;
          bestChild = int(i);
          bestSlot = slot;
        }
      }
    }
    childIn[bestSlot] = bestChild;
    placed |= 1u << uint(bestChild);
  }
}

// A power of two by its biased exponent.
double powerOf(int exponent) { return double(uintBitsToFloat(uint(exponent) << 23)); }

const int kLeastExponent = 27;  // of the pitch; as in wide_bvh.cpp

// The finest pitch, a power of two, with which 255 steps reach across.
int gridExponent(float low, float high) {
  const double extent = double(high) - double(low);
  int exponent = kLeastExponent;
  if (extent > 0.0lf) {
    const float steps = float(extent / 255.0lf);
    exponent = max(exponent, int((floatBitsToUint(steps) >> 23) & 255u) - 1);
  }
  while (double(low) + 255.0lf * powerOf(exponent) < double(high) && exponent < 254) ++exponent;
  return exponent;
}

uvec2 onGrid(float boxLow, float boxHigh, float origin, double pitch) {
  const double base = double(origin);
  uint low = uint(clamp(floor((double(boxLow) - base) / pitch), 0.0lf, 255.0lf));
  uint high = uint(clamp(ceil((double(boxHigh) - base) / pitch), 0.0lf, 255.0lf));
  // The differences may have been rounded.
  while (low > 0u && base + double(low) * pitch > double(boxLow)) --low;
  while (high < 255u && base + double(high) * pitch < double(boxHigh)) ++high;
  return uvec2(low, high);
}

void writeTriangle(uint at, uint sorted) {
  const uint triangle = order[sorted];
  const uvec3 t = treeTriangle(triangle);
  wideTriangles[3u * at] = vec4(treeVertex(t.x), uintBitsToFloat(triangle));
  wideTriangles[3u * at + 1u] = vec4(treeVertex(t.y), 0.0);
  wideTriangles[3u * at + 2u] = vec4(treeVertex(t.z), 0.0);
}

void writeNode(uint wide, uint level) {
  Child children[8];
  children[0] = childOf(tasks[wide]);
  const vec3 low = children[0].low, high = children[0].high;
  // Levels below this one, and how many are needed if the largest child is opened.
  const uint left = uint(kRayStack) - 1u - level, height = children[0].height;
  const uint count = divide(children, height > 0u && (height + 1u) / 3u > left);
  int childIn[8];
  setSlots(children, count, 0.5 * low + 0.5 * high, childIn);

  uint inner = 0u, triangles = 0u;
  for (uint i = 0u; i < count; ++i) {
    if (children[i].count > kTreeMostLeaf) ++inner;
    else triangles += children[i].count;
  }
  const uint firstNode = inner > 0u ? atomicAdd(control.nodes, inner) : 0u;
  const uint firstTriangle = triangles > 0u ? atomicAdd(control.triangles, triangles) : 0u;

  const ivec3 exponents =
      ivec3(gridExponent(low.x, high.x), gridExponent(low.y, high.y), gridExponent(low.z, high.z));
  uint innerMask = 0u, nextNode = firstNode, place = 0u;
  uint metas[2] = uint[2](0u, 0u);
  uint lows[3][2] = uint[3][2](uint[2](0u, 0u), uint[2](0u, 0u), uint[2](0u, 0u));
  uint highs[3][2] = lows;
  for (int slot = 0; slot < 8; ++slot) {
    if (childIn[slot] < 0) continue;
    const Child child = children[childIn[slot]];
    const int word = slot / 4, shift = 8 * (slot & 3);
    uint meta;
    if (child.count > kTreeMostLeaf) {
      innerMask |= 1u << uint(slot);
      meta = 0x38u + uint(slot);
      tasks[nextNode++] = child.node;
    } else {
      meta = ((1u << child.count) - 1u) << 5u | place;
      for (uint i = 0u; i < child.count; ++i) writeTriangle(firstTriangle + place + i, child.first + i);
      place += child.count;
    }
    metas[word] |= meta << shift;
    for (int axis = 0; axis < 3; ++axis) {
      const uvec2 steps = onGrid(child.low[axis], child.high[axis], low[axis], powerOf(exponents[axis]));
      lows[axis][word] |= steps.x << shift;
      highs[axis][word] |= steps.y << shift;
    }
  }
  wideNodes[5u * wide] = uvec4(floatBitsToUint(low), uint(exponents.x) | uint(exponents.y) << 8 |
                                                         uint(exponents.z) << 16 | innerMask << 24);
  wideNodes[5u * wide + 1u] = uvec4(firstNode, firstTriangle, metas[0], metas[1]);
  wideNodes[5u * wide + 2u] = uvec4(lows[0][0], lows[0][1], lows[1][0], lows[1][1]);
  wideNodes[5u * wide + 3u] = uvec4(lows[2][0], lows[2][1], highs[0][0], highs[0][1]);
  wideNodes[5u * wide + 4u] = uvec4(highs[1][0], highs[1][1], highs[2][0], highs[2][1]);
}

void setNextLevel() {
  control.levelFirst = control.levelEnd;
  control.levelEnd = atomicAdd(control.nodes, 0u);
  const uint groups =
      (control.levelEnd - control.levelFirst + uint(kTreeCollapseGroup) - 1u) / uint(kTreeCollapseGroup);
  // Rows of groups: no dimension has more than 65,535.
  const uint rows = (groups + 65534u) / 65535u;
  control.groupsX = rows > 0u ? (groups + rows - 1u) / rows : 0u;
  control.groupsY = rows;
  control.groupsZ = 1u;
  control.groupsDone = 0u;
  if (groups > 0u) ++control.level;
}

#ifdef ALONE
shared uint sharedFirst, sharedEnd, sharedLevel;

void main() {
  const uint me = gl_LocalInvocationIndex;
  if (begins && me == 0u) {
    control.nodes = 1u;
    control.triangles = 0u;
    control.levelFirst = 0u;
    control.levelEnd = 1u;
    control.level = 0u;
    control.groupsX = control.groupsY = control.groupsDone = 0u;
    control.groupsZ = 1u;
    tasks[0] = control.root;
    if (control.valid == 0u) {  // a root without children
      for (uint i = 0u; i < 5u; ++i) wideNodes[i] = uvec4(0u);
      wideNodes[0].w = 0x7f7f7fu;
      control.levelEnd = 0u;
    }
  }
  while (true) {
    memoryBarrierBuffer();
    barrier();
    if (me == 0u) {
      sharedFirst = control.levelFirst;
      sharedEnd = control.levelEnd;
      sharedLevel = control.level;
    }
    barrier();
    const uint first = sharedFirst, end = sharedEnd;
    if (end - first > most || end == first) break;
    for (uint wide = first + me; wide < end; wide += uint(kTreeCollapseGroup)) writeNode(wide, sharedLevel);
    memoryBarrierBuffer();
    barrier();
    if (me == 0u) setNextLevel();
  }
}
#else
void main() {
  const uint first = control.levelFirst, end = control.levelEnd, level = control.level;
  const uint wide = first + (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * uint(kTreeCollapseGroup) +
                    gl_LocalInvocationIndex;
  if (wide < end) writeNode(wide, level);
  memoryBarrierBuffer();
  barrier();
  if (gl_LocalInvocationIndex == 0u) {
    const uint groups = gl_NumWorkGroups.x * gl_NumWorkGroups.y;
    if (atomicAdd(control.groupsDone, 1u) + 1u == groups) setNextLevel();
  }
}
#endif
