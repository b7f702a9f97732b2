// SPDX-License-Identifier: BSD-3-Clause
// Between rounds: what the next one is dispatched over, and at last what is diced and drawn. One invocation. See
// queues.cpp.
#include "renderer/frame/frame_bindings.h"
#include "renderer/techniques/recursion/recursion_bindings.h"

layout(local_size_x = 1) in;
layout(std430, binding = kSplitCountersBuffer) buffer Counters { RecursionCounters counters; };
layout(std430, binding = kListedTrianglesBuffer) writeonly buffer Count { RasterCount listed_; };

uniform uint partCapacity, indicesPerPart;

uvec2 groupsFor(uint groups) {
  const uint rows = (groups + 65534u) / 65535u;
  return rows == 0u ? uvec2(0u) : uvec2((groups + rows - 1u) / rows, rows);
}

void main() {
  counters.queued = min(counters.next, partCapacity);
  counters.next = 0u;
  if (counters.queued > 0u) ++counters.rounds;
  const uvec2 groups = groupsFor((counters.queued + uint(kRecursionGroup) - 1u) / uint(kRecursionGroup));
  counters.groupsX = groups.x;
  counters.groupsY = groups.y;
  counters.groupsZ = 1u;
  const uint finished = min(counters.finished, partCapacity);
  const uvec2 dice = groupsFor(finished);
  counters.diceGroupsX = dice.x;
  counters.diceGroupsY = dice.y;
  counters.diceGroupsZ = 1u;
  counters.indices = finished * indicesPerPart;
  listed_.triangles = counters.indices / 3u;
  counters.instances = 1u;
  counters.firstIndex = 0u;
  counters.baseVertex = 0u;
  counters.baseInstance = 0u;
}
