// SPDX-License-Identifier: BSD-3-Clause
// A triangle's columns of voxels, numbered from 0 on, and what it fills of each by COVERAGE.
#include "renderer/voxels/voxel_entry.glsl"
#include "renderer/voxels/voxel_triangle.glsl"

layout(local_size_x = kVoxelizeGroup) in;
layout(binding = kVoxelBitsImage, r32ui) uniform uimage2DArray bitsImage;
layout(std430, binding = kVoxelQueueBuffer) buffer Queue {
  VoxelQueueHeader queue;
  uvec2 queueParts[];  // triangle, first column
};
uniform uint queueCapacity;  // parts
uniform int queueTurn;       // which of the counts is this run's; the other is 0 when the run ends

void fill(ivec3 voxel, vec3 place, uint id, VoxelTriangle t) {
#ifndef OCCUPIED_SUMS  // for which another run has set the bits
  const ivec3 texel = ivec3(voxel.x >> 5, voxel.yz);
  const uint bit = 1u << (voxel.x & 31);
  // Without a look at the word first: that takes an NVIDIA H200 a tenth to a fifth longer.
  imageAtomicOr(bitsImage, texel, bit);
#endif
#ifdef SUMS
  addEntry(voxel, place, id, t);
#endif
}

// Some invocation's rays were cut short.
void reportRays() {
#ifdef TRACED
  if (rayCutShort) atomicAdd(queue.cutShort, 1u);
#endif
}

#if COVERAGE == COVERAGE_THIN
// Columns of all three axes, one after another.
struct Work {
  Columns along0, along1, along2;
};
Work workOf(VoxelTriangle t) {
  Work work;
  work.along0 = columnsOf(t, 0, true);
  work.along1 = columnsOf(t, 1, true);
  work.along2 = columnsOf(t, 2, true);
  return work;
}
int workCount(Work work) { return columnCount(work.along0) + columnCount(work.along1) + columnCount(work.along2); }
#else
struct Work {
  Columns columns;
  int axis;
};
Work workOf(VoxelTriangle t) {
  Work work;
  work.axis = axisOfTriangle(t.a, t.b, t.c);
  work.columns = columnsOf(t, work.axis, COVERAGE == COVERAGE_DOMINANT);
  return work;
}
int workCount(Work work) { return columnCount(work.columns); }
#endif

void fillColumn(VoxelTriangle t, uint id, Columns columns, int axis, int index) {
  const ivec2 column = columns.first + ivec2(index % columns.count.x, index / columns.count.x);
#if COVERAGE == COVERAGE_CONSERVATIVE
  const ivec2 places = placesAround(t, column, axis);
  for (int at = places.x; at <= places.y; ++at) {
    const ivec3 voxel = voxelOf(column, at, axis);
    if (meetsVoxel(t, voxel)) fill(voxel, nearestTo(t, vec3(voxel) + 0.5), id, t);
  }
#else
  float place;
  const int voxel = placeMet(t, column, axis, place);
  if (voxel < 0) return;
  fill(voxelOf(column, voxel, axis), pointOf(vec2(column) + 0.5, place, axis), id, t);
#endif
}

void takeColumn(VoxelTriangle t, uint id, Work work, int index) {
#if COVERAGE == COVERAGE_THIN
  const int first = columnCount(work.along0), second = first + columnCount(work.along1);
  // One call: the compiler copies functions to where they are called.
  const int axis = index < first ? 0 : index < second ? 1 : 2;
  Columns columns = work.along0;
  if (axis == 1) columns = work.along1;
  if (axis == 2) columns = work.along2;
  fillColumn(t, id, columns, axis, index - (axis == 0 ? 0 : axis == 1 ? first : second));
#else
  fillColumn(t, id, work.columns, work.axis, index);
#endif
}
