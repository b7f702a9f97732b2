// SPDX-License-Identifier: BSD-3-Clause
// Phase 5: indices of triangle strips, or of single triangles (LISTS: a slot is then a triangle). Some invocations for each
// patch, or one for each slot (VERTEX_PARALLEL). Lists are written four words at a time: a triangle's three, stored one by
// one, would touch each piece of memory three times. See compute.cpp.
#include "renderer/techniques/tessellation/compute/slots.glsl"

layout(std430, binding = kIndicesBuffer) writeonly buffer Indices { uint indices[]; };

#ifdef LISTS
layout(std430, binding = kIndicesBuffer) writeonly buffer IndexWords { uvec4 indexWords[]; };
const uint kIndicesPerSlot = 3u;

// The words [4 place, 4 place + 4) as far as they are the patch's, [begin, end). They lie in two triangles.
void writeWords(PatternPlan plan, uint firstVertex, uint place, uint begin, uint end) {
  const uint word = 4u * place, from = max(word, begin) - begin, triangle = from / 3u, corner = from - 3u * triangle;
  const uvec3 a = uvec3(patternTriangle(plan, int(triangle))) + firstVertex,
              b = uvec3(patternTriangle(plan, int(min(triangle + 1u, (end - begin) / 3u - 1u)))) + firstVertex;
  if (word >= begin && word + 4u <= end) {
    indexWords[place] = corner == 0u ? uvec4(a, b.x) : (corner == 1u ? uvec4(a.yz, b.xy) : uvec4(a.z, b));
    return;
  }
  // The other words are a neighbouring patch's, which may be written at the same time.
  const uint last = min(word + 4u, end);
  for (uint at = begin + from, k = corner; at < last; ++at, ++k) {
    const uvec3 t = k < 3u ? a : b;
    const uint c = k < 3u ? k : k - 3u;
    indices[at] = c == 0u ? t.x : (c == 1u ? t.y : t.z);
  }
}
#else
const uint kIndicesPerSlot = 1u;
#endif

uint stripIndex(PatternPlan plan, uint slot, uint firstVertex) {
  const int vertex = patternIndex(plan, int(slot));
  return vertex == kPatternRestart ? 0xffffffffu : firstVertex + uint(vertex);
}

#ifdef VERTEX_PARALLEL
#ifdef LISTS
shared uint groupIndices[3 * kTessellationGroup];
#endif

void main() {
  const uint local = gl_LocalInvocationIndex, group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  const uint slots = totals.indices / kIndicesPerSlot;
  const uint firstSlot = group * uint(kTessellationGroup), slot = firstSlot + local;
  if (firstSlot >= slots) return;
  const uint number = patchOfSlot(firstSlot, slots, 1);
  const uvec2 first = slotOffsets[number];
  const PatternPlan plan = planOf(number, shapeOf(patches[number]));
#ifdef LISTS
  const uvec3 corners =
      slot < slots ? uvec3(patternTriangle(plan, int(slot - first.y))) + first.x : uvec3(0u);
  groupIndices[3u * local] = corners.x;
  groupIndices[3u * local + 1u] = corners.y;
  groupIndices[3u * local + 2u] = corners.z;
  barrier();
  // The buffer's length is a multiple of four words.
  const uint place = group * uint(3 * kTessellationGroup / 4) + local;
  if (local < uint(3 * kTessellationGroup / 4) && 4u * place < totals.indices)
    indexWords[place] = uvec4(groupIndices[4u * local], groupIndices[4u * local + 1u], groupIndices[4u * local + 2u],
                              groupIndices[4u * local + 3u]);
#else
  if (slot < slots) indices[slot] = stripIndex(plan, slot - first.y, first.x);
#endif
}
#else
void main() {
  const PatchLane at = patchLane(totals.indexLaneBits);
  if (at.number >= totals.patches) return;
  const uvec2 first = slotOffsets[at.number];
  const uint count = slotOffsets[at.number + 1u].y - first.y;
  if (count == 0u) return;
  const PatternPlan plan = planOf(at.number, shapeOf(patches[at.number]));
#ifdef LISTS
  const uint begin = 3u * first.y, end = begin + 3u * count;
  for (uint place = begin / 4u + at.lane; 4u * place < end; place += at.lanes)
    writeWords(plan, first.x, place, begin, end);
#else
  for (uint slot = at.lane; slot < count; slot += at.lanes)
    indices[first.y + slot] = stripIndex(plan, slot, first.x);
#endif
}
#endif
