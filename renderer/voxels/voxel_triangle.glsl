// SPDX-License-Identifier: BSD-3-Clause
// A triangle among voxels: which columns it may meet, and which voxels of a column it does. All lengths in voxels.
#include "renderer/frame/scene_buffers.glsl"
#include "renderer/voxels/volume.glsl"
#include "renderer/voxels/voxel_axes.glsl"

struct VoxelTriangle {
  vec3 a, b, c;
  vec3 normal;     // by the order of the vertices; its length has no meaning. 0: without area
  vec3 low, high;  // its box
  float reach;     // largest of the normal's components, by size
};

// From its vertices, in voxels. False: outside the grid, or not finite.
bool setUp(out VoxelTriangle t, vec3 a, vec3 b, vec3 c) {
  t.a = a;
  t.b = b;
  t.c = c;
  t.low = min(t.a, min(t.b, t.c));
  t.high = max(t.a, max(t.b, t.c));
  t.normal = cross(t.b - t.a, t.c - t.a);
  const vec3 size = abs(t.normal);
  t.reach = max(size.x, max(size.y, size.z));
  const vec3 sum = t.a + t.b + t.c;
  if (any(isnan(sum)) || any(isinf(sum)) || isinf(t.reach)) return false;
  return all(lessThanEqual(t.low, vec3(gridSize()) + kVoxelSlack)) && all(greaterThanEqual(t.high, vec3(-kVoxelSlack)));
}

bool loadTriangle(uint id, out VoxelTriangle t) {
  const uvec3 vertices = sceneTriangle(id);
  return setUp(t, toVoxels(scenePosition(vertices.x)), toVoxels(scenePosition(vertices.y)), toVoxels(scenePosition(vertices.z)));
}

// Voxel from its column and its place along it.
ivec3 voxelOf(ivec2 column, int place, int axis) {
  return axis == 0 ? ivec3(place, column) : axis == 1 ? ivec3(column.y, place, column.x) : ivec3(column, place);
}

vec3 pointOf(vec2 column, float place, int axis) {
  return axis == 0 ? vec3(place, column) : axis == 1 ? vec3(column.y, place, column.x) : vec3(column, place);
}

struct Columns {
  ivec2 first, count;
};

int columnCount(Columns columns) { return columns.count.x * columns.count.y; }

// Whose middle lines (`middles`) or whose whole width may meet the triangle.
Columns columnsOf(VoxelTriangle t, int axis, bool middles) {
  const float shift = middles ? 0.5 : 0.0;
  const vec2 low = across(t.low, axis) - shift - kVoxelSlack, high = across(t.high, axis) - shift + kVoxelSlack;
  const ivec2 size = across(gridSize(), axis);
  Columns columns;
  columns.first = clamp(ivec2(middles ? ceil(low) : floor(low)), ivec2(0), size);
  columns.count = max(clamp(ivec2(floor(high)), ivec2(-1), size - 1) - columns.first + 1, ivec2(0));
  return columns;
}

bool isBeside(vec2 p, vec2 from, vec2 to, float side, float slack) {
  const vec2 edge = to - from, toPoint = p - from;
  return side * (edge.x * toPoint.y - edge.y * toPoint.x) < -slack * length(edge);
}

// Where the middle line of a column meets the triangle's plane.
float placeAtMiddle(VoxelTriangle t, vec2 middle, int axis) {
  const vec2 n = across(t.normal, axis);
  return t.a[axis] - dot(n, middle - across(t.a, axis)) / t.normal[axis];
}

// Of a triangle thinner than the slack the plane is rounding: whether a place in it lies off the longest edge.
bool isStray(VoxelTriangle t, vec3 at) {
  const vec3 ab = t.b - t.a, bc = t.c - t.b, ca = t.a - t.c;
  const float first = dot(ab, ab), second = dot(bc, bc), third = dot(ca, ca), longest = max(first, max(second, third));
  if (t.reach * t.reach > kVoxelSlack * kVoxelSlack * longest) return false;
  const vec3 edge = longest == first ? ab : longest == second ? bc : ca;
  const vec3 fromStart = at - (longest == first ? t.a : longest == second ? t.b : t.c);
  const vec3 off = fromStart - clamp(dot(fromStart, edge) / max(longest, 1e-30), 0.0, 1.0) * edge;
  return dot(off, off) > 9.0 * kVoxelSlack * kVoxelSlack;
}

// Voxel of a column whose middle line the triangle meets, border included, and where; -1: none.
int placeMet(VoxelTriangle t, ivec2 column, int axis, out float place) {
  place = 0.0;
  const float along = t.normal[axis];
  if (along == 0.0) return -1;
  const vec2 middle = vec2(column) + 0.5, a = across(t.a, axis), b = across(t.b, axis), c = across(t.c, axis);
  // So little that the place is off by no more than the slack.
  const float side = along < 0.0 ? -1.0 : 1.0, slack = kVoxelSlack * abs(along) / t.reach;
  if (isBeside(middle, a, b, side, slack) || isBeside(middle, b, c, side, slack) || isBeside(middle, c, a, side, slack))
    return -1;
  place = clamp(placeAtMiddle(t, middle, axis), t.low[axis], t.high[axis]);
  const int size = gridSize()[axis];
  if (!(place >= -kVoxelSlack && place <= float(size) + kVoxelSlack)) return -1;
  if (isStray(t, pointOf(middle, place, axis))) return -1;
  return clamp(int(floor(place)), 0, size - 1);
}

// Height below which a triangle's plane, half a voxel beyond its border, is known no better than to the slack.
const float kSliver = 0.05;

// Voxels of a column that the triangle may meet: first and last.
ivec2 placesAround(VoxelTriangle t, ivec2 column, int axis) {
  float low = t.low[axis], high = t.high[axis];
  const float along = abs(t.normal[axis]);
  const vec3 longest = t.high - t.low;
  if (along > kSliver * max(longest.x, max(longest.y, longest.z))) {
    const vec2 n = abs(across(t.normal, axis));
    const float middle = placeAtMiddle(t, vec2(column) + 0.5, axis), half_ = (0.5 + kVoxelSlack) * (n.x + n.y) / along;
    low = max(low, middle - half_);
    high = min(high, middle + half_);
  }
  const int size = gridSize()[axis];
  return ivec2(clamp(int(floor(low - 2.0 * kVoxelSlack)), 0, size - 1),
               clamp(int(floor(high + 2.0 * kVoxelSlack)), 0, size - 1));
}

bool areApart(float p, float q, float reach) { return min(p, q) > reach || max(p, q) < -reach; }

// Along the cross products of an edge with the axes. `from`, `other`: an end of the edge and the vertex opposite.
bool isApartAcross(vec3 edge, vec3 from, vec3 other, float half_) {
  const vec3 size = half_ * abs(edge);
  return areApart(edge.y * from.z - edge.z * from.y, edge.y * other.z - edge.z * other.y, size.y + size.z) ||
         areApart(edge.z * from.x - edge.x * from.z, edge.z * other.x - edge.x * other.z, size.z + size.x) ||
         areApart(edge.x * from.y - edge.y * from.x, edge.x * other.y - edge.y * other.x, size.x + size.y);
}

// Whether the triangle meets a voxel grown by the slack: the 13 axes along which a triangle and a box may be apart.
bool meetsVoxel(VoxelTriangle t, ivec3 voxel) {
  const vec3 middle = vec3(voxel) + 0.5;
  const float half_ = 0.5 + kVoxelSlack;
  if (any(greaterThan(t.low - middle, vec3(half_))) || any(lessThan(t.high - middle, vec3(-half_)))) return false;
  const vec3 a = t.a - middle, b = t.b - middle, c = t.c - middle;
  // All corners: of a sliver the normal is rounding, and its plane holds none of them exactly.
  const vec3 size = abs(t.normal), at = vec3(dot(t.normal, a), dot(t.normal, b), dot(t.normal, c));
  const float reach = half_ * (size.x + size.y + size.z);
  if (min(at.x, min(at.y, at.z)) > reach || max(at.x, max(at.y, at.z)) < -reach) return false;
  return !isApartAcross(b - a, a, c, half_) && !isApartAcross(c - b, b, a, half_) && !isApartAcross(a - c, c, b, half_);
}

// Point of the triangle nearest to p (Ericson 2005, section 5.1.5); of one without area, some point of it near p.
vec3 nearestTo(VoxelTriangle t, vec3 p) {
  const float least = 1e-30;
  const vec3 ab = t.b - t.a, ac = t.c - t.a;
  const float d1 = dot(ab, p - t.a), d2 = dot(ac, p - t.a);
  if (d1 <= 0.0 && d2 <= 0.0) return t.a;
  const float d3 = dot(ab, p - t.b), d4 = dot(ac, p - t.b);
  if (d3 >= 0.0 && d4 <= d3) return t.b;
  const float beyondAb = d1 * d4 - d3 * d2;
  if (beyondAb <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return t.a + ab * (d1 / max(d1 - d3, least));
  const float d5 = dot(ab, p - t.c), d6 = dot(ac, p - t.c);
  if (d6 >= 0.0 && d5 <= d6) return t.c;
  const float beyondAc = d5 * d2 - d1 * d6;
  if (beyondAc <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return t.a + ac * (d2 / max(d2 - d6, least));
  const float beyondBc = d3 * d6 - d5 * d4, alongBc = d4 - d3, leftBc = d5 - d6;
  if (beyondBc <= 0.0 && alongBc >= 0.0 && leftBc >= 0.0) return t.b + (t.c - t.b) * (alongBc / max(alongBc + leftBc, least));
  const float sum = max(beyondBc + beyondAc + beyondAb, least);
  const float v = clamp(beyondAc / sum, 0.0, 1.0), w = clamp(beyondAb / sum, 0.0, 1.0 - v);
  return t.a + v * ab + w * ac;
}
