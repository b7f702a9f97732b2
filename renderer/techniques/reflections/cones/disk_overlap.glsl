// SPDX-License-Identifier: BSD-3-Clause
// What a convex polygon of up to OVERLAP_CORNERS corners has in common with the unit disk around 0, as diskOverlapByEdges() in
// disk_overlap.h, in single precision: x is the area, yz the centroid.
#ifndef OVERLAP_CORNERS
#define OVERLAP_CORNERS 4
#endif

float cross2(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

// Area and first moment of the triangle (0, p, q), signed.
vec3 triangleSums(vec2 p, vec2 q) {
  const float area = 0.5 * cross2(p, q);
  return vec3(area, area * (p + q) / 3.0);
}

// Of the sector between the directions of p and q.
vec3 sectorSums(vec2 p, vec2 q) {
  const float turn = atan(cross2(p, q), dot(p, q));
  const vec2 first = normalize(p), last = normalize(q);
  return vec3(0.5 * turn, vec2(last.y - first.y, first.x - last.x) / 3.0);
}

// Of what the triangle (0, p, q) has in common with the disk.
vec3 edgeSums(vec2 p, vec2 q) {
  const vec2 edge = q - p;
  const float a = dot(edge, edge), b = dot(p, edge);
  if (a == 0.0) return vec3(0.0);
  const float distance_ = cross2(p, edge) * inversesqrt(a);
  const float halfChord = sqrt(max(1.0 - distance_ * distance_, 0.0)) * inversesqrt(a);
  const float low = clamp(-b / a - halfChord, 0.0, 1.0), high = clamp(-b / a + halfChord, 0.0, 1.0);
  if (low >= high) return sectorSums(p, q);
  const vec2 entry = p + low * edge, leaving = p + high * edge;
  vec3 sums = triangleSums(entry, leaving);
  if (low > 0.0) sums += sectorSums(p, entry);
  if (high < 1.0) sums += sectorSums(leaving, q);
  return sums;
}

vec3 diskOverlap(in vec2 corners[OVERLAP_CORNERS], int count) {
  if (count < 3) return vec3(0.0);
  bool inside = true;
  for (int i = 0; i < count; ++i) {
    // Asked outright: a compiler may turn a comparison round, and what was false for a NaN is true then.
    if (any(isnan(corners[i])) || any(isinf(corners[i]))) return vec3(0.0);
    inside = inside && dot(corners[i], corners[i]) <= 1.0;
  }
  // A small figure inside loses digits unless it is measured from one of its own corners.
  const vec2 from = inside ? corners[0] : vec2(0.0);
  vec3 sums = vec3(0.0);
  for (int i = 0; i < count; ++i) {
    const vec2 p = corners[i], q = corners[i + 1 < count ? i + 1 : 0];
    sums += inside ? triangleSums(p - from, q - from) : edgeSums(p, q);
  }
  const float area = abs(sums.x);
  // Rounding alone leaves less than this of a figure that does not meet the disk.
  if (!(area > (inside ? 0.0 : 2e-6))) return vec3(0.0);
  return vec3(area, from + sums.yz / sums.x);
}
