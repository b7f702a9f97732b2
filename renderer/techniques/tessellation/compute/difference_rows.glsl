// SPDX-License-Identifier: BSD-3-Clause
// A row of samples of a bicubic patch by forward differences. DIFFERENCE: BicubicPoint, or float of the component LANE.
#include "renderer/surfaces/forward_differences.glsl"

#ifdef LANE
DIFFERENCE controlPoint(int index) { return bezierPoint(index)[LANE]; }
#else
DIFFERENCE controlPoint(int index) { return bicubicPoint(index); }
#endif

// The curve at a v, and its derivative along v, in powers of u.
struct DifferenceRow {
  CubicPowers value, across;
};
struct DifferenceRuns {
  CubicRun value, across;
  QuadraticRun along;
};

DifferenceRow differenceRow(float v, float rest) {
  precise const vec4 basis = cubicBasis(v, rest);
  const vec3 slope = 3.0 * quadraticBasis(v, rest);
  DIFFERENCE points[4], slopes[4];
  for (int i = 0; i < 4; ++i) {
    const DIFFERENCE a = controlPoint(i), b = controlPoint(i + 4), c = controlPoint(i + 8), d = controlPoint(i + 12);
    points[i] = a * basis.x + b * basis.y + c * basis.z + d * basis.w;
    slopes[i] = (b - a) * slope.x + (c - b) * slope.y + (d - c) * slope.z;
  }
  DifferenceRow row;
  row.value = powersOf(points[0], points[1], points[2], points[3]);
  row.across = powersOf(slopes[0], slopes[1], slopes[2], slopes[3]);
  return row;
}

DifferenceRuns differenceRuns(DifferenceRow row, int column, int segments) {
  const float by = 1.0 / float(segments), u = gridFraction(column, segments);
  DifferenceRuns runs;
  runs.value = cubicRun(row.value, u, by);
  runs.across = cubicRun(row.across, u, by);
  runs.along = slopeRun(row.value, u, by);
  return runs;
}

void advance(inout DifferenceRuns runs) {
  step_(runs.value);
  step_(runs.across);
  step_(runs.along);
}

// Samples that neighbours have as well are evaluated directly, unless they are copied later: then the corners alone are.
bool isDirect(ivec4 s) {
#ifdef COPIED
  return (s.x == 0 || s.x == s.y) && (s.z == 0 || s.z == s.w);
#else
  return s.x == 0 || s.x == s.y || s.z == 0 || s.z == s.w;
#endif
}
