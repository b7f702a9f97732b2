// SPDX-License-Identifier: BSD-3-Clause
// Mask of the light samples that a triangle hides from a point, as the intersection of four half-spaces of the light's
// plane: within the three planes through the point and an edge, and beyond the triangle's own plane. All four are bounded by
// straight lines on the light, also where the triangle reaches behind the point or through the light's plane, so nothing is
// clipped. Schwarz 2009, section 3.3 ("Backprojecting triangles"). Needs occlusion_mask.glsl with a grid.
//
// A line is the same for both triangles at an edge: worked out from the corners in one order, then turned. A sample is taken
// by exactly one side of it.
#include "renderer/techniques/soft_shadows/bitmask/mask_rows.glsl"

// slope . s + constant >= 0, s in light extents from the light's centre.
struct HalfSpaceOfLight {
  vec2 slope;
  float constant;
};

HalfSpaceOfLight turned(HalfSpaceOfLight h) { return HalfSpaceOfLight(-h.slope, -h.constant); }

// Not the built-in functions, which need not give the same bits wherever they are compiled.
vec3 exactCross(vec3 a, vec3 b) {
  precise const float x = a.y * b.z - a.z * b.y, y = a.z * b.x - a.x * b.z, z = a.x * b.y - a.y * b.x;
  return vec3(x, y, z);
}
float exactDot(vec3 a, vec3 b) {
  precise const float sum = a.x * b.x + a.y * b.y + a.z * b.z;
  return sum;
}

// Where n . l >= offset, l on the light.
HalfSpaceOfLight halfSpaceOfLight(vec3 n, float offset, vec2 size) { return HalfSpaceOfLight(n.xy * size, -offset); }

bool precedes(vec3 a, vec3 b) {
  if (a.x != b.x) return a.x < b.x;
  if (a.y != b.y) return a.y < b.y;
  return a.z < b.z;
}

// To the side of the plane through p, a and b to which cross(a - p, b - p) points.
HalfSpaceOfLight besideEdge(vec3 a, vec3 b, vec3 p, vec2 size) {
  const bool reversed = precedes(b, a);
  const vec3 from = reversed ? b : a, to = reversed ? a : b;
  precise const vec3 sight = from - p, along = to - from;
  const vec3 n = exactCross(sight, along);
  const HalfSpaceOfLight h = halfSpaceOfLight(n, exactDot(n, from), size);
  if (reversed) return turned(h);
  return h;
}

// Bits of the samples (i + offset) / side at the height y from the light's centre.
uint rowWithin(HalfSpaceOfLight h, float y, float offset) {
  precise const float rest = h.slope.y * y + h.constant;
  if (h.slope.x == 0.0) return rest >= 0.0 ? bitRange(0, kSamplesAlong) : 0u;
  precise const float place = (0.5 - rest / h.slope.x) * float(kSamplesAlong) - offset;
  const int before = int(ceil(clamp(place, 0.0, float(kSamplesAlong))));
  return h.slope.x > 0.0 ? bitRange(before, kSamplesAlong) : bitRange(0, before);
}

uint rowWithinAll(HalfSpaceOfLight bounds[4], float y, float offset) {
  return rowWithin(bounds[0], y, offset) & rowWithin(bounds[1], y, offset) & rowWithin(bounds[2], y, offset) &
         rowWithin(bounds[3], y, offset);
}

// Enters the samples of rows [first, end) that lie within all bounds.
void addToMaskWithin(HalfSpaceOfLight bounds[4], int first, int end) {
  for (int j = first; j < end; ++j) {
#if SAMPLE_PLACES == SAMPLE_PLACES_JITTERED_GRID
    const float offset = (j & 1) == 0 ? 0.25 : 0.75;
    const uint even = rowWithinAll(bounds, (float(j) + 0.75) / 16.0 - 0.5, offset),
               odd = rowWithinAll(bounds, (float(j) + 0.25) / 16.0 - 0.5, offset);
    addRow(j, joinedColumns(even, odd));
#else
    addRow(j, rowWithinAll(bounds, (float(j) + 0.5) / float(kSamplesAlong) - 0.5, 0.5));
#endif
  }
}

// Rows of samples that the triangle's projection may reach. Corners as deep as p have none: then all rows.
ivec2 rowsReached(vec3 a, vec3 b, vec3 c, vec3 p, float lightHeight) {
  const vec3 above = p.z - vec3(a.z, b.z, c.z);
  const float nearest = min(above.x, min(above.y, above.z));
  const float reach = p.z / nearest;
  // Coordinates are below 1 and known to 2^-24 each, which the projection magnifies; a row for the rounding to rows.
  const float rounding = exp2(-20.0) * reach / lightHeight * float(kSamplesAlong) + 1.0;
  if (!(nearest > 0.0 && rounding < float(kSamplesAlong))) return ivec2(0, kSamplesAlong);
  const vec3 y = p.y + (vec3(a.y, b.y, c.y) - p.y) * (p.z / above);
  const vec3 rows = (y / lightHeight + 0.5) * float(kSamplesAlong);
  const float low = min(rows.x, min(rows.y, rows.z)) - rounding, high = max(rows.x, max(rows.y, rows.z)) + rounding;
  return ivec2(int(clamp(low, 0.0, float(kSamplesAlong))), int(ceil(clamp(high, 0.0, float(kSamplesAlong)))));
}

// `planeTolerance`: a plane so near to p is one that p lies in; it is seen edge-on. `lightMargin`: share of the way to the
// light's plane that an occluder may not enter.
bool addTriangleToMask(vec3 a, vec3 b, vec3 c, vec3 p, vec2 size, float planeTolerance, float lightMargin) {
  const ivec2 rows = rowsReached(a, b, c, p, size.y);
  if (rows.x >= rows.y) return false;
  const vec3 n = exactCross(b - a, c - a);
  const float height = exactDot(n, a - p);
  // Written so that a triangle without area, or a NaN, hides nothing.
  if (!(height * height > planeTolerance * planeTolerance * dot(n, n))) return false;
  HalfSpaceOfLight bounds[4];
  bounds[0] = besideEdge(a, b, p, size);
  bounds[1] = besideEdge(b, c, p, size);
  bounds[2] = besideEdge(c, a, p, size);
  // Seen from p along l - p the triangle's plane is met at height / n.(l - p) of the way, at most 1 - lightMargin.
  bounds[3] = halfSpaceOfLight(n, exactDot(n, a) - lightMargin * exactDot(n, p), size);
  bounds[3].slope *= 1.0 - lightMargin;
  // That holds for the half-space with the larger n.(l - p); of the other side of the triangle all is reversed.
  if (height < 0.0)
    for (int i = 0; i < 4; ++i) bounds[i] = turned(bounds[i]);
  addToMaskWithin(bounds, rows.x, rows.y);
  return true;
}
