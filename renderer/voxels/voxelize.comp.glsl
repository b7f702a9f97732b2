// SPDX-License-Identifier: BSD-3-Clause
// All triangles into voxels by one dispatch: an invocation sets up a triangle, and takes its columns if they are few; a group
// shares the columns of larger ones. Groups of several layers z share these further.
#include "renderer/voxels/voxel_triangle.glsl"
#ifdef SUMS
#include "renderer/frame/surface_buffers.glsl"
#endif

layout(local_size_x = kVoxelizeGroup) in;
layout(binding = kVoxelBitsImage, r32ui) uniform uimage2DArray bitsImage;
uniform uint triangleCount;

#ifdef SUMS
layout(std430, binding = kVoxelSumsBuffer) buffer Sums { uint voxelSums[]; };

void addEntry(ivec3 voxel, uint id, VoxelTriangle t) {
  const uint first = kVoxelSums * uint(voxel.x + gridSizeX * (voxel.y + gridSizeY * voxel.z));
  const SurfaceMaterial material = surfaceMaterials[surfaceMaterialOf[id]];
  atomicAdd(voxelSums[first], 1u);
#ifdef VOLUME_ALBEDO
  const uvec3 albedo = uvec3(round(kVoxelFixed * material.albedo));
  atomicAdd(voxelSums[first + 1u], albedo.x);
  atomicAdd(voxelSums[first + 2u], albedo.y);
  atomicAdd(voxelSums[first + 3u], albedo.z);
#endif
#ifdef VOLUME_NORMAL
  const vec3 unit = t.reach > 0.0 ? normalize(t.normal / t.reach) : vec3(0.0);
  const ivec3 normal = ivec3(round(kVoxelFixed * unit));
  atomicAdd(voxelSums[first + 4u], uint(normal.x));
  atomicAdd(voxelSums[first + 5u], uint(normal.y));
  atomicAdd(voxelSums[first + 6u], uint(normal.z));
  const float opacity = 1.0 - dot(material.transmittance, vec3(1.0 / 3.0));
  atomicAdd(voxelSums[first + 7u], uint(round(kVoxelFixed * opacity)));
#endif
}
#endif

void fill(ivec3 voxel, uint id, VoxelTriangle t) {
  const ivec3 texel = ivec3(voxel.x >> 5, voxel.yz);
  const uint bit = 1u << (voxel.x & 31);
  if ((imageLoad(bitsImage, texel).x & bit) == 0u) imageAtomicOr(bitsImage, texel, bit);
#ifdef SUMS
  addEntry(voxel, id, t);
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
  work.axis = longestAxis(t.reach > 0.0 ? t.normal : vec3(0.0, 0.0, 1.0));
  work.columns = columnsOf(t, work.axis, COVERAGE == COVERAGE_DOMINANT);
  return work;
}
int workCount(Work work) { return columnCount(work.columns); }
#endif

void fillColumn(VoxelTriangle t, uint id, Columns columns, int axis, int index) {
  const ivec2 column = columns.first + ivec2(index % columns.count.x, index / columns.count.x);
#if COVERAGE == COVERAGE_CONSERVATIVE
  const ivec2 places = placesAround(t, column, axis);
  for (int place = places.x; place <= places.y; ++place) {
    const ivec3 voxel = voxelOf(column, place, axis);
    if (meetsVoxel(t, voxel)) fill(voxel, id, t);
  }
#else
  const int place = placeMet(t, column, axis);
  if (place >= 0) fill(voxelOf(column, place, axis), id, t);
#endif
}

void takeColumn(VoxelTriangle t, uint id, Work work, int index) {
#if COVERAGE == COVERAGE_THIN
  const int first = columnCount(work.along0), second = first + columnCount(work.along1);
  if (index < first)
    fillColumn(t, id, work.along0, 0, index);
  else if (index < second)
    fillColumn(t, id, work.along1, 1, index - first);
  else
    fillColumn(t, id, work.along2, 2, index - second);
#else
  fillColumn(t, id, work.columns, work.axis, index);
#endif
}

shared uint largeTriangles[kVoxelizeGroup];
shared uint largeCount;

void main() {
  const uint lane = gl_LocalInvocationIndex;
  const uint id = uint(kVoxelizeGroup) * (gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y) + lane;
  if (lane == 0u) largeCount = 0u;
  barrier();
  VoxelTriangle t;
  if (id < triangleCount && loadTriangle(id, t)) {
    const Work own = workOf(t);
    const int count = workCount(own);
    if (count > kVoxelizeAlone)
      largeTriangles[atomicAdd(largeCount, 1u)] = id;
    else if (gl_WorkGroupID.z == 0u)
      for (int i = 0; i < count; ++i) takeColumn(t, id, own, i);
  }
  barrier();
  for (uint k = 0u; k < largeCount; ++k) {
    const uint large = largeTriangles[k];
    loadTriangle(large, t);
    const Work shared_ = workOf(t);
    const int count = workCount(shared_), step_ = kVoxelizeGroup * int(gl_NumWorkGroups.z);
    for (int i = int(gl_WorkGroupID.z) * kVoxelizeGroup + int(lane); i < count; i += step_) takeColumn(t, large, shared_, i);
  }
}
