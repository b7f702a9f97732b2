// SPDX-License-Identifier: BSD-3-Clause
// A round of recursion: each part in the queue is culled, finished or split into the next queue. See queues.cpp.
#include "renderer/techniques/recursion/recursion_bindings.h"
#include "renderer/techniques/tessellation/patches.glsl"

vec4 patchPoint(uint i) { return patchPoints[i]; }
#include "renderer/techniques/recursion/part_flatness.glsl"

layout(local_size_x = kRecursionGroup) in;
layout(std430, binding = kSplitCountersBuffer) buffer Counters { RecursionCounters counters; };
layout(std430, binding = kQueueBuffer) readonly buffer Queue { RecursionPart queue[]; };
layout(std430, binding = kNextQueueBuffer) writeonly buffer NextQueue { RecursionPart nextQueue[]; };
layout(std430, binding = kFinishedBuffer) writeonly buffer Finished { RecursionPart finishedParts[]; };

uniform uint partCapacity, mostSteps;
uniform bool cull;

void finish(RecursionPart part) {
  const uint slot = atomicAdd(counters.finished, 1u);
  if (slot < partCapacity) {
    finishedParts[slot] = part;
  } else {
    atomicAdd(counters.leftOut, 1u);
  }
}

void main() {
  const uint number = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * uint(kRecursionGroup) + gl_LocalInvocationIndex;
  if (number >= counters.queued) return;
  const RecursionPart part = queue[number];
  if (part.patchNumber == 0xffffffffu) return;  // a slot that was not used
  atomicAdd(counters.tests, 1u);
  const TessellatedPatch patch_ = patches[part.patchNumber];
  const bool rectangle = isRectangle(shapeOf(patch_));
  const PartTest test = testOf(part, patch_.firstPoint, rectangle);
  if (cull && test.outside) {
    atomicAdd(counters.culled, 1u);
    return;
  }
  if (!test.any_ || part.steps >= mostSteps) {
    if (test.any_) atomicAdd(counters.cutShort, 1u);
    finish(part);
    return;
  }
#ifdef HALVES
  const uint parts = rectangle ? 2u : 4u;
#else
  const uint parts = 4u;
#endif
  const uint slot = atomicAdd(counters.next, parts);
  if (slot + parts > partCapacity) {
    // No room: drawn as it is. The slots up to the capacity are not read, as they are marked empty.
    for (uint i = slot; i < min(slot + parts, partCapacity); ++i) nextQueue[i] = RecursionPart(vec4(0.0), 0.0, 0.0, 0xffffffffu, 0u);
    atomicAdd(counters.cutShort, 1u);
    finish(part);
    return;
  }
  for (uint i = 0u; i < parts; ++i)
    nextQueue[slot + i] = parts == 4u ? quarterOf(part, rectangle, i) : halfOf(part, test, i);
}
