// SPDX-License-Identifier: BSD-3-Clause
// The wide tree that rays are traced through (WideNode in wide_bvh.h) from the binary one, a level after the other. A node
// opens the child of the largest surface, as the build on the CPU does. Where the levels that the rays' stack has left
// would not do for that, it opens the highest child: nodes whose height is at most 2 less than the node's are 7 at most,
// all of which are opened, so that each level takes 3 off the height.
//
// ALONE: one group takes levels until there are more than `most` nodes in one; else a dispatch takes one level.
#include "renderer/ray_tracing/ray_tracing_bindings.h"
#include "renderer/ray_tracing/tree_triangles.glsl"

#ifdef ALONE
const int kGroup = kTreeAloneGroup;
#else
const int kGroup = kTreeCollapseGroup;
#endif
layout(local_size_x = kGroup) in;
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

// Eight invocations make a node together, each has one of its children.
const uint kTeams = uint(kGroup) / 8u;
shared uint childCount[kGroup], childLeft[kGroup], childRight[kGroup];
shared float childCost[kGroup];
shared uint slotCount[kGroup];
shared uint firstNodes[kTeams], firstTriangles[kTeams];
shared uint nodeWords[kTeams * 20u];

float halfArea(BinaryNode node) {
  const vec3 extent = node.high - node.low;
  return extent.x * extent.y + extent.y * extent.z + extent.z * extent.x;
}

// Of `count` children, those of invocations from `team` on; -1: none is left to open.
int childToOpen(uint team, uint count) {
  // Leaves last, and the longest of what costs the same.
  for (int leaves = 0; leaves < 2; ++leaves) {
    int best = -1;
    float cost = 0.0;
    uint length_ = 0u;
    for (uint i = 0u; i < count; ++i) {
      const uint triangles = childCount[team + i];
      if (triangles < 2u || (triangles <= kTreeMostLeaf) != (leaves == 1)) continue;
      const float own = childCost[team + i];
      if (best < 0 || own > cost || (own == cost && triangles > length_)) {
        best = int(i);
        cost = own;
        length_ = triangles;
      }
    }
    if (best >= 0) return best;
  }
  return -1;
}

// Opens children until there are eight; returns how many there are. `own`: the node of this number, then the invocation's child.
uint divide(inout BinaryNode own, inout uint node, uint count, bool byHeight) {
  const uint me = gl_LocalInvocationIndex, lane = me & 7u, team = me - lane;
  for (int round = 0; round < 7; ++round) {
    childCount[me] = own.count;
    childCost[me] = own.count <= kTreeMostLeaf ? halfArea(own) * float(own.count)
                                               : byHeight ? float(own.height) : halfArea(own);
    childLeft[me] = own.left;
    childRight[me] = own.right;
    barrier();
    const int opened = childToOpen(team, count);
    uint left = 0u, right = 0u;
    if (opened >= 0) {
      left = childLeft[team + uint(opened)];
      right = childRight[team + uint(opened)];
    }
    barrier();
    if (opened < 0) continue;
    if (int(lane) == opened || lane == count) {
      node = int(lane) == opened ? left : right;
      own = nodes[node];
    }
    ++count;
  }
  return count;
}

// In which octant of the node the invocation's child lies. The child that is farthest out chooses first.
uint chosenSlot(BinaryNode own, uint count, vec3 middle) {
  const uint me = gl_LocalInvocationIndex, lane = me & 7u, team = me - lane;
  const vec3 from = (0.5 * own.low + 0.5 * own.high) - middle;
  uint free = 0xffu, slot = 0u;
  bool placed = lane >= count;
  for (uint n = 0u; n < 8u; ++n) {
    float farthest = 0.0;
    uint best = kTreeNone;
    for (uint i = 0u; i < 8u; ++i) {
      if (placed || (free >> i & 1u) == 0u) continue;
      const float along = ((i & 4u) != 0u ? from.x : -from.x) + ((i & 2u) != 0u ? from.y : -from.y) +
                          ((i & 1u) != 0u ? from.z : -from.z);
      if (best == kTreeNone || along > farthest) {
        farthest = along;
        best = i;
      }
    }
    childCost[me] = farthest;
    childLeft[me] = best;
    barrier();
    uint chosen = kTreeNone;
    for (uint i = 0u; i < count; ++i)
      if (childLeft[team + i] != kTreeNone && (chosen == kTreeNone || childCost[team + i] > childCost[team + chosen]))
        chosen = i;
    const uint taken = chosen == kTreeNone ? 0u : childLeft[team + chosen];
    barrier();
    if (chosen == kTreeNone) continue;
    free &= ~(1u << taken);
    if (chosen == lane) {
      slot = taken;
      placed = true;
    }
  }
  return slot;
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

// Up to three triangles from `first` on in the sorted order, read together.
void writeTriangles(uint at, uint first, uint count) {
  uint triangle[kTreeMostLeaf];
  uvec3 vertices[kTreeMostLeaf];
  for (uint i = 0u; i < kTreeMostLeaf; ++i) triangle[i] = order[first + min(i, count - 1u)];
  for (uint i = 0u; i < kTreeMostLeaf; ++i) vertices[i] = treeTriangle(triangle[i]);
  vec4 corners[3u * kTreeMostLeaf];
  for (uint i = 0u; i < kTreeMostLeaf; ++i) {
    corners[3u * i] = vec4(treeVertex(vertices[i].x), uintBitsToFloat(triangle[i]));
    corners[3u * i + 1u] = vec4(treeVertex(vertices[i].y), 0.0);
    corners[3u * i + 2u] = vec4(treeVertex(vertices[i].z), 0.0);
  }
  for (uint i = 0u; i < kTreeMostLeaf; ++i)
    if (i < count)
      for (uint k = 0u; k < 3u; ++k) wideTriangles[3u * (at + i) + k] = corners[3u * i + k];
}

// By all invocations of the group; `has`, whether there is such a node, is the same for eight.
void writeNode(uint wide, uint level, bool has) {
  const uint me = gl_LocalInvocationIndex, lane = me & 7u, team = me - lane, number = me / 8u;
  BinaryNode own = BinaryNode(vec3(0.0), 0u, vec3(0.0), 0u, 0u, 0u, 0u, 0u);
  uint node = has ? tasks[wide] : 0u;
  if (has) own = nodes[node];
  const vec3 low = own.low, high = own.high;
  // Levels below this one, and how many are needed if the largest child is opened.
  const uint left = uint(kRayStack) - 1u - level, height = own.height;
  const uint count = divide(own, node, has ? 1u : 0u, height > 0u && (height + 1u) / 3u > left);
  const uint slot = chosenSlot(own, count, 0.5 * low + 0.5 * high);

  slotCount[me] = 0u;
  for (uint i = lane; i < 20u; i += 8u) nodeWords[20u * number + i] = 0u;
  barrier();
  const bool hasChild = lane < count;
  if (hasChild) slotCount[team + slot] = own.count;
  barrier();
  uint inner = 0u, innerBefore = 0u, triangles = 0u, trianglesBefore = 0u, innerMask = 0u;
  for (uint i = 0u; i < 8u; ++i) {
    const uint in_ = slotCount[team + i];
    if (in_ > kTreeMostLeaf) {
      if (i < slot) ++innerBefore;
      ++inner;
      innerMask |= 1u << i;
    } else {
      if (i < slot) trianglesBefore += in_;
      triangles += in_;
    }
  }
  if (lane == 0u) firstNodes[number] = inner > 0u ? atomicAdd(control.nodes, inner) : 0u;
  if (lane == 1u) firstTriangles[number] = triangles > 0u ? atomicAdd(control.triangles, triangles) : 0u;
  barrier();
  const uint firstNode = firstNodes[number], firstTriangle = firstTriangles[number];

  const ivec3 exponents =
      ivec3(gridExponent(low.x, high.x), gridExponent(low.y, high.y), gridExponent(low.z, high.z));
  const uint words = 20u * number;
  if (hasChild) {
    const uint word = slot / 4u, shift = 8u * (slot & 3u);
    uint meta;
    if (own.count > kTreeMostLeaf) {
      meta = 0x38u + slot;
      tasks[firstNode + innerBefore] = node;
    } else {
      meta = ((1u << own.count) - 1u) << 5u | trianglesBefore;
      writeTriangles(firstTriangle + trianglesBefore, own.first, own.count);
    }
    atomicOr(nodeWords[words + 6u + word], meta << shift);
    for (uint axis = 0u; axis < 3u; ++axis) {
      const uvec2 steps = onGrid(own.low[axis], own.high[axis], low[axis], powerOf(exponents[axis]));
      atomicOr(nodeWords[words + 8u + 2u * axis + word], steps.x << shift);
      atomicOr(nodeWords[words + 14u + 2u * axis + word], steps.y << shift);
    }
  }
  if (lane == 0u) {
    nodeWords[words] = floatBitsToUint(low.x);
    nodeWords[words + 1u] = floatBitsToUint(low.y);
    nodeWords[words + 2u] = floatBitsToUint(low.z);
    nodeWords[words + 3u] = uint(exponents.x) | uint(exponents.y) << 8 | uint(exponents.z) << 16 | innerMask << 24;
    nodeWords[words + 4u] = firstNode;
    nodeWords[words + 5u] = firstTriangle;
  }
  barrier();
  if (has && lane < 5u) {
    const uint from = words + 4u * lane;
    wideNodes[5u * wide + lane] =
        uvec4(nodeWords[from], nodeWords[from + 1u], nodeWords[from + 2u], nodeWords[from + 3u]);
  }
}

void setNextLevel() {
  control.levelFirst = control.levelEnd;
  control.levelEnd = atomicAdd(control.nodes, 0u);
  const uint each = uint(kTreeCollapseGroup) / 8u;  // nodes
  const uint groups = (control.levelEnd - control.levelFirst + each - 1u) / each;
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
    const uint level = sharedLevel;
    for (uint from = first; from < end; from += kTeams) writeNode(from + me / 8u, level, from + me / 8u < end);
    memoryBarrierBuffer();
    barrier();
    if (me == 0u) setNextLevel();
  }
}
#else
void main() {
  const uint first = control.levelFirst, end = control.levelEnd, level = control.level;
  const uint wide = first + (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * kTeams +
                    gl_LocalInvocationIndex / 8u;
  writeNode(wide, level, wide < end);
  memoryBarrierBuffer();
  barrier();
  if (gl_LocalInvocationIndex == 0u) {
    const uint groups = gl_NumWorkGroups.x * gl_NumWorkGroups.y;
    if (atomicAdd(control.groupsDone, 1u) + 1u == groups) setNextLevel();
  }
}
#endif
