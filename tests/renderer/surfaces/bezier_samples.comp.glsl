// SPDX-License-Identifier: BSD-3-Clause
// Evaluates patches at given points, for comparison with double precision.
#include "tests/renderer/surfaces/bezier_samples_bindings.h"

layout(local_size_x = 64) in;
layout(std430, binding = kBezierPointsBuffer) readonly buffer Points { vec4 points[]; };
struct Sample {
  ivec4 shape;     // first point, degrees (0 in z: a triangle), 1: by the functions of fixed degree
  ivec4 place;     // i, m, j, n of a rectangle's grid; i, j, m of a triangle's
  vec4 diagonal;   // of the control points, in x
};
layout(std430, binding = kBezierSamplesBuffer) readonly buffer Samples { Sample samples[]; };
layout(std430, binding = kBezierResultsBuffer) writeonly buffer Results { vec4 results[]; };  // p, u, v, uu, uv, vv, normal and rung
uniform int count;

int first = 0;
vec4 bezierPoint(int index) { return points[first + index]; }
#include "renderer/surfaces/bezier.glsl"

void main() {
  const int index = int(gl_GlobalInvocationID.x);
  if (index >= count) return;
  const Sample s = samples[index];
  first = s.shape.x;
  const bool triangle = s.shape.z == 0, fixedDegree = s.shape.w == 1;
  const vec4 at = triangle ? triangleGridPoint(s.place.x, s.place.y, s.place.z)
                           : rectangleGridPoint(s.place.x, s.place.y, s.place.z, s.place.w);
  BezierJet jet;
  if (triangle) {
    jet = bezierTriangle(s.shape.y, at, 2);
    if (fixedDegree) {
      vec4 c[10];
      for (int k = 0; k < 10; ++k) c[k] = bezierPoint(k);
      jet.p = cubicTriangleSum(at, c);
    }
  } else {
    jet = bezierRectangle(s.shape.y, s.shape.z, at, 2);
    if (fixedDegree) {
      const BezierJet fast = bezierBicubic(at);
      jet.p = fast.p, jet.u = fast.u, jet.v = fast.v;
    }
  }
  const SurfaceJet surface = projectJet(jet);
  int rung;
  const vec3 normal = bezierNormal(surface, triangle ? triangleInwards(at) : rectangleInwards(at), s.diagonal.x, rung);
  results[7 * index] = vec4(surface.p, 0.0);
  results[7 * index + 1] = vec4(surface.u, 0.0);
  results[7 * index + 2] = vec4(surface.v, 0.0);
  results[7 * index + 3] = vec4(surface.uu, 0.0);
  results[7 * index + 4] = vec4(surface.uv, 0.0);
  results[7 * index + 5] = vec4(surface.vv, 0.0);
  results[7 * index + 6] = vec4(normal, float(rung));
}
