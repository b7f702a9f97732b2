// SPDX-License-Identifier: BSD-3-Clause
// Samples of depth images on a grid of points, and the voxels that they lie in.
#include "renderer/incremental_voxels/depth_views.glsl"

uniform int pointsPerSide, subsets, subset;
uniform vec2 pointShift;  // of all points, in cells of the grid; 0.5: the cells' middles

struct SeenSample {
  ivec2 pixel;
  vec3 place;  // in voxels
  ivec3 voxel;
};

// Invocation `index` of a subset to a point of the grid; false: beyond it.
bool pointOf(int index, out ivec2 point) {
  const int first = index * subsets;
  const int number = first + (subset + first / pointsPerSide) % subsets;
#if POINTS == POINTS_BLOCKS
  // Blocks of 8 x 8 one after another; those at the right and lower edge are narrower.
  const int rows = 8 * pointsPerSide, band = number / rows, height = max(min(8, pointsPerSide - 8 * band), 1);
  const int within = number - rows * band, column = within / (8 * height), width = max(min(8, pointsPerSide - 8 * column), 1);
  const int inBlock = within - 8 * height * column;
  point = ivec2(8 * column + inBlock % width, 8 * band + inBlock / width);
#else
  point = ivec2(number % pointsPerSide, number / pointsPerSide);
#endif
  return number < pointsPerSide * pointsPerSide;
}

// False: nothing is seen there, or outside the grid.
bool sampleOf(int view, int index, out SeenSample seen) {
  ivec2 point;
  if (!pointOf(index, point)) return false;
  vec2 cell = vec2(point) + pointShift;
#if POINTS == POINTS_STIPPLE
  if ((point.y & 1) != 0) cell.x += 0.5;
#endif
  const ivec2 size = viewSizePx[view];
  seen.pixel = min(ivec2(cell / float(pointsPerSide) * vec2(size)), size - 1);
  const float depth = depthAt(view, seen.pixel);
  if (!(depth > 0.0)) return false;
  const vec3 ray = viewRay(view, seen.pixel);
  seen.place = (voxelsFromView[view] * vec4(viewNear[view] / depth * ray, 1.0)).xyz;
  const vec3 behind = seen.place + kSampleNudge * normalize(mat3(voxelsFromView[view]) * ray);
  // What lies in the grid's borders is in it.
  const vec3 size3 = vec3(gridSize());
  if (!(all(greaterThanEqual(seen.place, vec3(-kVoxelSlack))) && all(lessThanEqual(seen.place, size3 + kVoxelSlack)))) return false;
  seen.voxel = clamp(ivec3(floor(behind)), ivec3(0), gridSize() - 1);
  return true;
}
