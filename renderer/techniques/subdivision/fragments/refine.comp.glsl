// SPDX-License-Identifier: BSD-3-Clause
// A step of subdivision of the fragments that reach the next level, an invocation a point of theirs.
#include "renderer/techniques/subdivision/fragments/fragment.glsl"

layout(local_size_x = kFragmentGroup) in;
layout(std430, binding = kFragmentTargetBuffer) writeonly buffer Target { vec4 target[]; };
uniform uint sourceLevel;

vec3 ringEdgeAfter(int i) {
  const vec3 v = gridPoint(0, 0), e = ringEdge(i);
  if (ringSharp(i)) return middleRule(v, e);
  return edgeRule(v, e, ringEdge(i + 1), ringFace(i), ringEdge(i - 1), ringFace(i - 1));
}

vec3 gridPointAfter(ivec2 at) {
  const int own = int(fragment_.own);
  if (!has(kFragmentRegular)) {
    // Beside (0, 0) the grid may have fewer or more neighbours than four.
    if (at == ivec2(-1, 0)) return inRing(own + 2) ? ringEdgeAfter(own + 2) : gridPoint(0, 0);
    if (at == ivec2(0, -1)) return inRing(own - 1) ? ringEdgeAfter(own - 1) : gridPoint(0, 0);
    if (at == ivec2(-1)) return gridPoint(0, 0);  // not looked at
  }
  const ivec2 odd = at & 1, o = (at - odd) / 2;
  if (odd == ivec2(1))
    return faceRule(gridPoint(o.x, o.y), gridPoint(o.x + 1, o.y), gridPoint(o.x + 1, o.y + 1), gridPoint(o.x, o.y + 1));
  if (odd == ivec2(0)) return vertexAt(o.x, o.y, false);
  const ivec2 end = o + odd, across = odd.yx;
  const vec3 a = gridPoint(o.x, o.y), b = gridPoint(end.x, end.y);
  if (odd.x == 1 ? o.y == 0 && has(kFragmentSharpX) : o.x == 0 && has(kFragmentSharpY)) return middleRule(a, b);
  return edgeRule(a, b, gridPoint(o.x + across.x, o.y + across.y), gridPoint(end.x + across.x, end.y + across.y),
                  gridPoint(o.x - across.x, o.y - across.y), gridPoint(end.x - across.x, end.y - across.y));
}

vec3 ringPointAfter(uint place) {
  const int i = int(place / 2u);
  if (i >= int(fragment_.edges)) return gridPoint(0, 0);
  if (place % 2u == 0u) return ringEdgeAfter(i);
  return faceRule(gridPoint(0, 0), ringEdge(i), ringFace(i), ringEdge(i + 1));
}

void main() {
  const uint i = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * uint(kFragmentGroup);
  const uint size = blockPoints(2 * segments), at = i / size, local = i % size;
  if (at >= fragmentsOfLevel(sourceLevel + 1u)) return;
  const uint number = listedFragment(sourceLevel + 1u, at);
  openFragment(number);
  const uint grid = gridPoints(2 * segments);
  target[number * size + local] = vec4(local < grid ? gridPointAfter(gridPlace(local, 2 * segments)) : ringPointAfter(local - grid), 0.0);
}
