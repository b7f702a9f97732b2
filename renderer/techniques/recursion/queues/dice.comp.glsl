// SPDX-License-Identifier: BSD-3-Clause
// A group for each finished part: its grid of vertices and triangles. See queues.cpp.
#include "renderer/techniques/recursion/recursion_bindings.h"
#include "renderer/techniques/tessellation/evaluate.glsl"
#include "renderer/techniques/tessellation/store_vertex.glsl"

layout(local_size_x = kRecursionGroup) in;
layout(std430, binding = kDiceCountersBuffer) readonly buffer Counters { RecursionCounters counters; };
layout(std430, binding = kFinishedBuffer) readonly buffer Finished { RecursionPart finishedParts[]; };
layout(std430, binding = kIndicesBuffer) writeonly buffer Indices { uvec2 indexPairs[]; };

uniform uint partCapacity;
uniform int grid;  // segments of a part's sides

// Ends are exact, so that parts with a common corner share its bits.
vec2 along(vec2 from, vec2 to, int i) { return i == grid ? to : from + (to - from) * (float(i) / float(grid)); }

void main() {
  const uint number = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  if (number >= min(counters.finished, partCapacity)) return;
  const RecursionPart part = finishedParts[number];
  const TessellatedPatch patch_ = patches[part.patchNumber];
  const bool rectangle = isRectangle(shapeOf(patch_));
  const uint side = uint(grid) + 1u, slots = side * side, firstVertex = number * slots,
             firstPair = number * uint(3 * grid * grid);
  for (uint slot = gl_LocalInvocationIndex; slot < slots; slot += uint(kRecursionGroup)) {
    const int i = int(slot % side), j = int(slot / side);
    vec4 point;
    if (rectangle) {
      const vec2 at = vec2(along(part.corners.xy, part.corners.zw, i).x, along(part.corners.xy, part.corners.zw, j).y);
      point = vec4(at, 1.0 - at);
    } else {
      // A triangle's rows end early: the other slots stay unused.
      if (i + j > grid) continue;
      const vec2 a = part.corners.xy, b = part.corners.zw, c = vec2(part.lastU, part.lastV);
      const float u = float(grid - i - j) / float(grid), v = float(i) / float(grid), w = float(j) / float(grid);
      const vec2 at = u * a + v * b + w * c;
      point = vec4(at, 1.0 - at.x - at.y, 0.0);
    }
    storeVertex(firstVertex + slot, surfaceVertex(patch_, point));
  }
  for (uint cell = gl_LocalInvocationIndex; cell < uint(grid * grid); cell += uint(kRecursionGroup)) {
    const uint i = cell % uint(grid), j = cell / uint(grid);
    const uint s = firstVertex + i + side * j, at = firstPair + 3u * cell;
    const bool lower = rectangle || i + j < uint(grid), upper = rectangle || i + j + 1u < uint(grid);
    indexPairs[at] = uvec2(s, lower ? s + 1u : s);
    indexPairs[at + 1u] =
        uvec2(lower ? (rectangle ? s + side + 1u : s + side) : s, upper ? (rectangle ? s : s + 1u) : s);
    indexPairs[at + 2u] = uvec2(upper ? s + side + 1u : s, upper ? s + side : s);
  }
}
