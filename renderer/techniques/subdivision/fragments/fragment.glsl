// SPDX-License-Identifier: BSD-3-Clause
// Points of a fragment at one level, and its rules of subdivision (Catmull and Clark 1978). Sums are grouped so that they
// give the same bits from whichever fragment a vertex or an edge is seen. LISTED: fragments stop at different levels.
#include "renderer/techniques/subdivision/fragments/fragment_bindings.h"

layout(std430, binding = kFragmentsBuffer) readonly buffer Fragments { FragmentRecord fragments[]; };
layout(std430, binding = kFragmentPointsBuffer) readonly buffer FragmentPoints { vec4 fragmentPoints[]; };
uniform uint fragmentCount, ringPoints;
#ifdef LISTED
layout(std430, binding = kFragmentListsBuffer) readonly buffer Lists { uint lists[]; };
layout(std430, binding = kFragmentDispatchesBuffer) readonly buffer Dispatches { FragmentDispatch dispatches[]; };
uint fragmentsOfLevel(uint level) { return dispatches[level].count; }
uint listedFragment(uint level, uint i) { return lists[level * fragmentCount + i]; }
#else
uint fragmentsOfLevel(uint level) { return fragmentCount; }
uint listedFragment(uint level, uint i) { return i; }
#endif
uniform int segments;  // of the level that is read

uint gridPoints(int n) { return uint((n + 3) * (n + 3)); }
uint blockPoints(int n) { return gridPoints(n) + ringPoints; }
ivec2 gridPlace(uint local, int n) { return ivec2(local % uint(n + 3), local / uint(n + 3)) - 1; }

FragmentRecord fragment_ = FragmentRecord(0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u);
uint firstPoint = 0u, firstRing = 0u;

void openFragment(uint number) {
  fragment_ = fragments[number];
  firstPoint = number * blockPoints(segments);
  firstRing = firstPoint + gridPoints(segments);
}
vec3 gridPoint(int x, int y) { return fragmentPoints[firstPoint + uint(x + 1 + (segments + 3) * (y + 1))].xyz; }
bool has(uint flag) { return (fragment_.flags & flag) != 0u; }

// Of the ring; `i` may lie once around outside.
uint ringAt(int i) {
  const int n = int(fragment_.edges);
  return uint(i < 0 ? i + n : (i >= n ? i - n : i));
}
bool inRing(int i) { return has(kFragmentClosed) || (i >= 0 && i < int(fragment_.edges)); }
vec3 ringEdge(int i) { return fragmentPoints[firstRing + 2u * ringAt(i)].xyz; }
vec3 ringFace(int i) { return fragmentPoints[firstRing + 2u * ringAt(i) + 1u].xyz; }
bool ringSharp(int i) {
  const uint at = ringAt(i);
  return ((at < 32u ? fragment_.sharpLow : fragment_.sharpHigh) >> (at & 31u) & 1u) != 0u;
}

// a and c opposite.
vec3 faceRule(vec3 a, vec3 b, vec3 c, vec3 d) {
  precise const vec3 out_ = 0.25 * ((a + c) + (b + d));
  return out_;
}
vec3 middleRule(vec3 a, vec3 b) {
  precise const vec3 out_ = 0.5 * (a + b);
  return out_;
}
// Of an edge from a to b; the others lie beside either.
vec3 edgeRule(vec3 a, vec3 b, vec3 leftA, vec3 leftB, vec3 rightA, vec3 rightB) {
  precise const vec3 out_ = 0.375 * (a + b) + 0.0625 * ((leftA + rightA) + (leftB + rightB));
  return out_;
}
// w v plus weights of the neighbours' sums.
vec3 weighted(float w, vec3 v, float e, vec3 edges, float f, vec3 faces) {
  precise const vec3 out_ = w * v + (e * edges + f * faces);
  return out_;
}
vec3 creaseRule(float w, vec3 v, vec3 a, vec3 b) {
  precise const vec3 out_ = w * v + 0.5 * (1.0 - w) * (a + b);
  return out_;
}
vec3 sumOfFour(vec3 a, vec3 b, vec3 c, vec3 d) {
  precise const vec3 out_ = (a + c) + (b + d);
  return out_;
}

vec3 gridEdges(int x, int y) {
  return sumOfFour(gridPoint(x + 1, y), gridPoint(x, y + 1), gridPoint(x - 1, y), gridPoint(x, y - 1));
}
vec3 gridFaces(int x, int y) {
  return sumOfFour(gridPoint(x + 1, y + 1), gridPoint(x - 1, y + 1), gridPoint(x - 1, y - 1), gridPoint(x + 1, y - 1));
}
vec3 ringEdges() {
  precise vec3 sum = vec3(0.0);
  for (int i = 0; i < int(fragment_.edges); ++i) sum += ringEdge(i);
  return sum;
}
vec3 ringFaces() {
  precise vec3 sum = vec3(0.0);
  for (int i = 0; i < int(fragment_.edges); ++i) sum += ringFace(i);
  return sum;
}
int sectorEnd() { return int(fragment_.sectorFirst + fragment_.sectorFaces); }

// What a vertex of the grid becomes. Positions: after a step with weights w, or in the limit.
vec3 vertexAt(int x, int y, bool limit) {
  const vec3 v = gridPoint(x, y);
  const float crease = limit ? 2.0 / 3.0 : 0.75;
  if (x == 0 && y == 0 && !has(kFragmentRegular)) {
    if (has(kFragmentCorner)) return v;
    if (has(kFragmentCrease)) return creaseRule(crease, v, ringEdge(int(fragment_.sectorFirst)), ringEdge(sectorEnd()));
    const float k = float(fragment_.edges);
    if (limit) return weighted(k / (k + 5.0), v, 4.0 / (k * (k + 5.0)), ringEdges(), 1.0 / (k * (k + 5.0)), ringFaces());
    return weighted(1.0 - 1.75 / k, v, 1.5 / (k * k), ringEdges(), 0.25 / (k * k), ringFaces());
  }
  if (y == 0 && has(kFragmentSharpX)) return creaseRule(crease, v, gridPoint(x - 1, y), gridPoint(x + 1, y));
  if (x == 0 && has(kFragmentSharpY)) return creaseRule(crease, v, gridPoint(x, y - 1), gridPoint(x, y + 1));
  if (limit) return weighted(4.0 / 9.0, v, 1.0 / 9.0, gridEdges(x, y), 1.0 / 36.0, gridFaces(x, y));
  return weighted(0.5625, v, 0.09375, gridEdges(x, y), 0.015625, gridFaces(x, y));
}
