// SPDX-License-Identifier: BSD-3-Clause
// NURBS at any parameters: the span by bisection, then Cox and de Boor's recursion (SC-16).
#include "renderer/techniques/tessellation/nurbs/nurbs_bindings.h"
#include "renderer/techniques/tessellation/tessellation_bindings.h"

layout(std430, binding = kNurbsSurfacesBuffer) readonly buffer Surfaces { NurbsRecord surfaces[]; };
layout(std430, binding = kNurbsPointsBuffer) readonly buffer Points { vec4 nurbsPoints[]; };
layout(std430, binding = kNurbsKnotsBuffer) readonly buffer Knots { float knots[]; };
layout(std430, binding = kNurbsParametersBuffer) readonly buffer Parameters { float parameters[]; };

uniform uint surfaceNumber;

// The last knot not above t that begins a span; the last knot of all belongs to the span before it.
int spanAt(uint firstKnot, int degree, int points, float t) {
  int low = degree, high = points;
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    if (knots[firstKnot + uint(middle)] <= t) {
      low = middle;
    } else {
      high = middle;
    }
  }
  return low;
}

BasisRecord basisAt(uint firstKnot, int degree, int points, float t) {
  const int k = spanAt(firstKnot, degree, points, t);
  BasisRecord out_;
  out_.first = uint(k - degree);
  for (int j = 0; j < kNurbsFunctions; ++j) out_.basis[j] = out_.slope[j] = 0.0;
  out_.basis[0] = 1.0;
  for (int r = 1; r <= degree; ++r) {
    float carried = 0.0, before = 0.0;
    for (int j = 0; j < r; ++j) {
      const float low = knots[firstKnot + uint(k + 1 + j - r)], high = knots[firstKnot + uint(k + 1 + j)];
      const float share = out_.basis[j] / (high - low);
      out_.basis[j] = carried + (high - t) * share;
      if (r == degree) out_.slope[j] = float(degree) * (before - share);
      carried = (t - low) * share;
      before = share;
    }
    out_.basis[r] = carried;
    if (r == degree) out_.slope[r] = float(degree) * before;
  }
  return out_;
}

struct NurbsJet {
  vec4 p, u, v;  // homogeneous
};

NurbsJet combined(NurbsRecord of, BasisRecord u, BasisRecord v) {
  NurbsJet jet = NurbsJet(vec4(0.0), vec4(0.0), vec4(0.0));
  for (uint j = 0u; j <= of.degreeV; ++j) {
    vec4 row = vec4(0.0), slope = vec4(0.0);
    for (uint i = 0u; i <= of.degreeU; ++i) {
      const vec4 point = nurbsPoints[of.firstPoint + u.first + i + of.pointsU * (v.first + j)];
      row += u.basis[i] * point;
      slope += u.slope[i] * point;
    }
    jet.p += v.basis[j] * row;
    jet.u += v.basis[j] * slope;
    jet.v += v.slope[j] * row;
  }
  return jet;
}

NurbsJet jetAt(NurbsRecord of, float u, float v) {
  return combined(of, basisAt(of.firstKnotU, int(of.degreeU), int(of.pointsU), u),
                  basisAt(of.firstKnotV, int(of.degreeV), int(of.pointsV), v));
}

// Of any length; whether the derivatives give none.
vec3 normalOf(NurbsJet jet, out bool degenerate) {
  const vec3 a = jet.p.w * jet.u.xyz - jet.u.w * jet.p.xyz, b = jet.p.w * jet.v.xyz - jet.v.w * jet.p.xyz, n = cross(a, b);
  const float aa = dot(a, a), bb = dot(b, b);
  degenerate = !(dot(n, n) > 1e-10 * aa * bb && aa > 1e-10 * bb && bb > 1e-10 * aa);
  return n;
}
