// SPDX-License-Identifier: BSD-3-Clause
// Bézier patches and triangles of degree 1 to 9, polynomial or rational, in single precision: bezier.h for
// shaders, with the same grouping of sums (Schwarz 2009, section 7.6.2; SC-01 to SC-05). Everything is
// `precise`: a fused multiply-add would make one side of a shared boundary differ from the other.
//
// The includer defines, before it includes this file, the control points of the patch in the order of
// patch_set.h, homogeneous (w x, w y, w z, w), relative to an anchor near the geometry:
//   vec4 bezierPoint(int index);
// NVIDIA's compiler regroups products of values that a function returns although they are `precise` there, so that Bernstein
// polynomials no longer mirror each other; it does not with this. Other compilers ignore it.
#pragma optionNV(fastmath off)
#include "renderer/surfaces/bezier_tables.h"

const float kBezierBinomials[55] = float[55](LIMEN_BINOMIALS);

// A point of the domain with what is left to 1 (domain_point.h): (u, v, 1 - u, 1 - v) of a rectangle,
// (u, v, w, unused) of a triangle.
// Division may be off by 2.5 units in the last place, and m / m must be 1: a boundary's points are its own alone.
float gridFraction(int i, int m) { return i == m ? 1.0 : float(i) / float(m); }
vec4 rectangleGridPoint(int i, int m, int j, int n) {
  return vec4(gridFraction(i, m), gridFraction(j, n), gridFraction(m - i, m), gridFraction(n - j, n));
}
vec4 triangleGridPoint(int i, int j, int m) {
  return vec4(gridFraction(i, m), gridFraction(j, m), gridFraction(m - i - j, m), 0.0);
}

// Value and derivatives with respect to u and v; of a triangle, w follows them.
struct BezierJet {
  vec4 p, u, v;     // homogeneous
  vec4 uu, uv, vv;  // 0 unless asked for
};
struct SurfaceJet {
  vec3 p, u, v, uu, uv, vv;  // units of the control points
};

// Bernstein polynomials of degree n; s = 1 - t.
void bernsteinBasis(int n, float t, float s, out float basis[10]) {
  precise float a[10], b[10], result[10];
  a[0] = 1.0, b[0] = 1.0;
  for (int i = 1; i <= n; ++i) a[i] = a[i - 1] * t, b[i] = b[i - 1] * s;
  for (int i = 0; i <= n; ++i) result[i] = kBezierBinomials[n * (n + 1) / 2 + i] * (a[i] * b[n - i]);
  basis = result;
}

// Mirrored terms first, as bezierSum() of bernstein.h.
vec4 bezierSum(int n, float basis[10], vec4 points[10]) {
  precise vec4 sum = points[0] * basis[0];
  if (n > 0) sum = sum + points[n] * basis[n];
  for (int i = 1; 2 * i < n; ++i) {
    precise vec4 pair = points[i] * basis[i] + points[n - i] * basis[n - i];
    sum = sum + pair;
  }
  if (n > 0 && (n & 1) == 0) sum = sum + points[n / 2] * basis[n / 2];
  return sum;
}

// Control points of the derivative, without the factor n.
void differences(int n, inout vec4 points[10]) {
  for (int i = 0; i < n; ++i) points[i] = points[i + 1] - points[i];
}

// Derivatives up to `order`, 0 to 2.
BezierJet bezierRectangle(int degreeU, int degreeV, vec4 at, int order) {
  // Of the degrees less 0, 1 and 2. Arrays of their own: NVIDIA's compiler refuses an array's element at a variable place as
  // an out argument.
  float basisU0[10], basisU1[10], basisU2[10], basisV0[10], basisV1[10], basisV2[10];
  bernsteinBasis(degreeU, at.x, at.z, basisU0);
  bernsteinBasis(degreeV, at.y, at.w, basisV0);
  if (order > 0) {
    bernsteinBasis(degreeU - 1, at.x, at.z, basisU1);
    bernsteinBasis(degreeV - 1, at.y, at.w, basisV1);
  }
  if (order > 1) {
    bernsteinBasis(max(degreeU - 2, 0), at.x, at.z, basisU2);
    bernsteinBasis(max(degreeV - 2, 0), at.y, at.w, basisV2);
  }
  const float m = float(degreeU), n = float(degreeV);
  vec4 row[10], p[10], u[10], uu[10];
  for (int j = 0; j <= degreeV; ++j) {
    for (int i = 0; i <= degreeU; ++i) row[i] = bezierPoint(i + (degreeU + 1) * j);
    p[j] = bezierSum(degreeU, basisU0, row);
    if (order == 0) continue;
    differences(degreeU, row);
    u[j] = m * bezierSum(degreeU - 1, basisU1, row);
    uu[j] = vec4(0.0);
    if (order == 1 || degreeU == 1) continue;
    differences(degreeU - 1, row);
    uu[j] = m * (m - 1.0) * bezierSum(degreeU - 2, basisU2, row);
  }
  BezierJet jet = BezierJet(bezierSum(degreeV, basisV0, p), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0));
  if (order == 0) return jet;
  jet.u = bezierSum(degreeV, basisV0, u);
  differences(degreeV, p);
  jet.v = n * bezierSum(degreeV - 1, basisV1, p);
  if (order == 1) return jet;
  jet.uu = bezierSum(degreeV, basisV0, uu);
  differences(degreeV, u);
  jet.uv = n * bezierSum(degreeV - 1, basisV1, u);
  if (degreeV == 1) return jet;
  differences(degreeV - 1, p);
  jet.vv = n * (n - 1.0) * bezierSum(degreeV - 2, basisV2, p);
  return jet;
}

// The four Bernstein polynomials of degree 3, in the bits of bernsteinBasis().
vec4 cubicBasis(float t, float s) {
  precise float tt = t * t, ss = s * s;
  precise float tss = t * ss, tts = tt * s;
  precise float b0 = ss * s, b1 = 3.0 * tss, b2 = 3.0 * tts, b3 = tt * t;
  return vec4(b0, b1, b2, b3);
}
vec4 cubicSum(vec4 basis, vec4 c0, vec4 c1, vec4 c2, vec4 c3) {
  precise vec4 outer = c0 * basis.x + c3 * basis.w;
  precise vec4 inner = c1 * basis.y + c2 * basis.z;
  precise vec4 sum = outer + inner;
  return sum;
}
// The three of degree 2 and their sum.
vec3 quadraticBasis(float t, float s) {
  precise float ts = t * s;
  precise float b0 = s * s, b1 = 2.0 * ts, b2 = t * t;
  return vec3(b0, b1, b2);
}
vec4 quadraticSum(vec3 basis, vec4 c0, vec4 c1, vec4 c2) {
  precise vec4 outer = c0 * basis.x + c2 * basis.z;
  precise vec4 sum = outer + c1 * basis.y;
  return sum;
}

// Points of a bicubic patch: homogeneous, or, if the includer says that all weights are 1, positions.
#ifdef LIMEN_POLYNOMIAL
#define BicubicPoint vec3
vec3 bicubicPoint(int index) { return bezierPoint(index).xyz; }
vec4 homogeneousPoint(vec3 p) { return vec4(p, 1.0); }
vec4 homogeneousDerivative(vec3 d) { return vec4(d, 0.0); }
vec3 cubicSum(vec4 basis, vec3 c0, vec3 c1, vec3 c2, vec3 c3) {
  precise vec3 outer = c0 * basis.x + c3 * basis.w;
  precise vec3 inner = c1 * basis.y + c2 * basis.z;
  precise vec3 sum = outer + inner;
  return sum;
}
vec3 quadraticSum(vec3 basis, vec3 c0, vec3 c1, vec3 c2) {
  precise vec3 outer = c0 * basis.x + c2 * basis.z;
  precise vec3 sum = outer + c1 * basis.y;
  return sum;
}
#else
#define BicubicPoint vec4
vec4 bicubicPoint(int index) { return bezierPoint(index); }
vec4 homogeneousPoint(vec4 p) { return p; }
vec4 homogeneousDerivative(vec4 d) { return d; }
#endif

// The curve along v at a u of a bicubic patch, and its derivative with respect to u.
struct BicubicColumn {
  BicubicPoint p0, p1, p2, p3, u0, u1, u2, u3;
};
void bicubicRow(int j, vec4 bu, vec3 du, out BicubicPoint p, out BicubicPoint u) {
  const BicubicPoint c0 = bicubicPoint(4 * j), c1 = bicubicPoint(4 * j + 1), c2 = bicubicPoint(4 * j + 2),
                     c3 = bicubicPoint(4 * j + 3);
  p = cubicSum(bu, c0, c1, c2, c3);
  u = 3.0 * quadraticSum(du, c1 - c0, c2 - c1, c3 - c2);
}
BicubicColumn bicubicColumn(float u, float rest) {
  precise const vec4 bu = cubicBasis(u, rest);
  precise const vec3 du = quadraticBasis(u, rest);
  precise BicubicColumn c;
  bicubicRow(0, bu, du, c.p0, c.u0);
  bicubicRow(1, bu, du, c.p1, c.u1);
  bicubicRow(2, bu, du, c.p2, c.u2);
  bicubicRow(3, bu, du, c.p3, c.u3);
  return c;
}
BezierJet bicubicAt(BicubicColumn c, float v, float rest) {
  precise const vec4 bv = cubicBasis(v, rest);
  precise const vec3 dv = quadraticBasis(v, rest);
  precise const BicubicPoint value = cubicSum(bv, c.p0, c.p1, c.p2, c.p3);
  return BezierJet(
      homogeneousPoint(value), homogeneousDerivative(cubicSum(bv, c.u0, c.u1, c.u2, c.u3)),
      homogeneousDerivative(3.0 * quadraticSum(dv, c.p1 - c.p0, c.p2 - c.p1, c.p3 - c.p2)),
      vec4(0.0), vec4(0.0), vec4(0.0));
}

// bezierRectangle(3, 3, at, 1) without loops over degrees and, but for LIMEN_POLYNOMIAL, with the same bits.
BezierJet bezierBicubic(vec4 at) { return bicubicAt(bicubicColumn(at.x, at.z), at.y, at.w); }

// Place of the point (i, j, k), i + j + k = n, of a triangle of degree n.
int triangleIndex(int n, int i, int k) { return (n - i) * (n - i + 1) / 2 + k; }

const int kNetPoints = 0, kNetU = 1, kNetV = 2, kNetUu = 3, kNetUv = 4, kNetVv = 5;

// Control points of a triangle of degree n or of one of its derivatives, without the factors n and n - 1.
vec4 triangleNet(int net, int n, int i, int j, int k) {
  if (net == kNetPoints) return bezierPoint(triangleIndex(n, i, k));
  const vec4 onW = bezierPoint(triangleIndex(n, i, net <= kNetV ? k + 1 : k + 2));
  if (net == kNetU) return bezierPoint(triangleIndex(n, i + 1, k)) - onW;
  if (net == kNetV) return bezierPoint(triangleIndex(n, i, k)) - onW;
  if (net == kNetUu)
    return (bezierPoint(triangleIndex(n, i + 2, k)) - bezierPoint(triangleIndex(n, i + 1, k + 1))) -
           (bezierPoint(triangleIndex(n, i + 1, k + 1)) - onW);
  if (net == kNetUv)
    return (bezierPoint(triangleIndex(n, i + 1, k)) - bezierPoint(triangleIndex(n, i + 1, k + 1))) -
           (bezierPoint(triangleIndex(n, i, k + 1)) - onW);
  return (bezierPoint(triangleIndex(n, i, k)) - bezierPoint(triangleIndex(n, i, k + 1))) -
         (bezierPoint(triangleIndex(n, i, k + 1)) - onW);
}

// Sum over a net of degree d (n, n - 1 or n - 2), grouped as triangleSum() of bezier.cpp.
vec4 triangleSum(int net, int n, int d, vec4 at) {
  precise float u[10], v[10], w[10];
  u[0] = 1.0, v[0] = 1.0, w[0] = 1.0;
  for (int i = 1; i <= d; ++i) u[i] = u[i - 1] * at.x, v[i] = v[i - 1] * at.y, w[i] = w[i - 1] * at.z;
#define LIMEN_TRIANGLE_TERM(I, J, K)                                                                     \
  (triangleNet(net, n, I, J, K) * (kBezierBinomials[d * (d + 1) / 2 + (I)] *                             \
                                   kBezierBinomials[(d - (I)) * (d - (I) + 1) / 2 + (J)] * (u[I] * v[J] * w[K])))
  if (d == 0) return triangleNet(net, n, 0, 0, 0);
  precise vec4 sum = LIMEN_TRIANGLE_TERM(d, 0, 0) + LIMEN_TRIANGLE_TERM(0, d, 0);
  sum = sum + LIMEN_TRIANGLE_TERM(0, 0, d);
  for (int i = 1; 2 * i < d; ++i) {
    precise vec4 onW = LIMEN_TRIANGLE_TERM(d - i, i, 0) + LIMEN_TRIANGLE_TERM(i, d - i, 0);
    precise vec4 onU = LIMEN_TRIANGLE_TERM(0, d - i, i) + LIMEN_TRIANGLE_TERM(0, i, d - i);
    precise vec4 onV = LIMEN_TRIANGLE_TERM(i, 0, d - i) + LIMEN_TRIANGLE_TERM(d - i, 0, i);
    precise vec4 sides = onW + onU;
    sides = sides + onV;
    sum = sum + sides;
  }
  if ((d & 1) == 0) {
    const int h = d / 2;
    precise vec4 sides = LIMEN_TRIANGLE_TERM(h, h, 0) + LIMEN_TRIANGLE_TERM(0, h, h);
    sides = sides + LIMEN_TRIANGLE_TERM(h, 0, h);
    sum = sum + sides;
  }
  for (int i = 1; i < d; ++i)
    for (int j = 1; i + j < d; ++j) sum = sum + LIMEN_TRIANGLE_TERM(i, j, d - i - j);
#undef LIMEN_TRIANGLE_TERM
  return sum;
}

// Derivatives up to `order`, 0 to 2.
BezierJet bezierTriangle(int degree, vec4 at, int order) {
  BezierJet jet = BezierJet(triangleSum(kNetPoints, degree, degree, at), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0),
                            vec4(0.0));
  if (order == 0) return jet;
  const float n = float(degree);
  jet.u = n * triangleSum(kNetU, degree, degree - 1, at);
  jet.v = n * triangleSum(kNetV, degree, degree - 1, at);
  if (order == 1 || degree == 1) return jet;
  jet.uu = n * (n - 1.0) * triangleSum(kNetUu, degree, degree - 2, at);
  jet.uv = n * (n - 1.0) * triangleSum(kNetUv, degree, degree - 2, at);
  jet.vv = n * (n - 1.0) * triangleSum(kNetVv, degree, degree - 2, at);
  return jet;
}

// A triangle of degree 3 from its ten points b300, b210, b201, b120, b111, b102, b030, b021, b012, b003 (the
// order of patch_set.h), with the bits of bezierTriangle(3, at, 0) in p. PN triangles: section 6.1.3.
vec4 cubicTriangleSum(vec4 at, vec4 c[10]) {
  precise float uu = at.x * at.x, vv = at.y * at.y, ww = at.z * at.z;
  precise vec4 corners = c[0] * (uu * at.x) + c[6] * (vv * at.y);
  corners = corners + c[9] * (ww * at.z);
  precise vec4 onW = c[1] * (3.0 * (uu * at.y)) + c[3] * (3.0 * (at.x * vv));
  precise vec4 onU = c[7] * (3.0 * (vv * at.z)) + c[8] * (3.0 * (at.y * ww));
  precise vec4 onV = c[5] * (3.0 * (at.x * ww)) + c[2] * (3.0 * (uu * at.z));
  precise vec4 sides = onW + onU;
  sides = sides + onV;
  precise vec4 sum = corners + sides;
  sum = sum + c[4] * (6.0 * (at.x * at.y * at.z));
  return sum;
}

// A vector field of degree 2 over a triangle from its six points n200, n110, n101, n020, n011, n002, as a PN
// triangle's normals.
vec3 quadraticTriangleField(vec4 at, vec3 n[6]) {
  precise vec3 corners = n[0] * (at.x * at.x) + n[3] * (at.y * at.y);
  corners = corners + n[5] * (at.z * at.z);
  precise vec3 sides = n[1] * (2.0 * (at.x * at.y)) + n[4] * (2.0 * (at.y * at.z));
  sides = sides + n[2] * (2.0 * (at.x * at.z));
  precise vec3 sum = corners + sides;
  return sum;
}

// Position alone: bits agree on boundaries that patches share.
vec3 bezierPosition(vec4 homogeneous) {
  precise vec3 p = homogeneous.xyz / homogeneous.w;
  return p;
}

// Quotient rules of rational surfaces.
SurfaceJet projectJet(BezierJet jet) {
  const vec3 p = bezierPosition(jet.p);
  const float w = jet.p.w;
  const vec3 u = (jet.u.xyz - jet.u.w * p) / w, v = (jet.v.xyz - jet.v.w * p) / w;
  return SurfaceJet(p, u, v, (jet.uu.xyz - 2.0 * jet.u.w * u - jet.uu.w * p) / w,
                    (jet.uv.xyz - jet.u.w * v - jet.v.w * u - jet.uv.w * p) / w,
                    (jet.vv.xyz - 2.0 * jet.v.w * v - jet.vv.w * p) / w);
}

// Sine of the angle between the derivatives, and their lengths as shares of the control points' diagonal,
// below which they count as degenerate.
const float kDegenerateTangents = 1e-4;

bool tangentsDegenerate(vec3 a, vec3 b, vec3 across, float diagonal) {
  const float lengthA = length(a), lengthB = length(b);
  return !(lengthA > kDegenerateTangents * diagonal && lengthB > kDegenerateTangents * diagonal &&
           length(across) > kDegenerateTangents * lengthA * lengthB);
}

// Directions into the domain across the sides on which the point lies, from elsewhere towards the middle.
vec2 rectangleInwards(vec4 at) {
  const vec2 inwards = vec2(lessThanEqual(at.xy, vec2(0.0))) - vec2(lessThanEqual(at.zw, vec2(0.0)));
  return inwards == vec2(0.0) ? 0.5 - at.xy : inwards;
}
vec2 triangleInwards(vec4 at) {
  const vec3 on = vec3(lessThanEqual(at.xyz, vec3(0.0)));
  const vec2 inwards = on.xy - 0.5 * (on.yx + on.zz);
  return on == vec3(0.0) ? 1.0 / 3.0 - at.xy : inwards;
}

// Unit normal and its rung, from derivatives up to the second (SC-04); LIMEN_NORMAL_NONE and (0, 0, 1) if the
// first two rungs of the ladder give none: the caller may evaluate at a point further inside.
vec3 bezierNormal(SurfaceJet jet, vec2 inwards, float diagonal, out int rung) {
  rung = LIMEN_NORMAL_TANGENTS;
  const vec3 across = cross(jet.u, jet.v);
  if (!tangentsDegenerate(jet.u, jet.v, across, diagonal)) return normalize(across);
  rung = LIMEN_NORMAL_LIMIT;
  const vec3 changeU = jet.uu * inwards.x + jet.uv * inwards.y, changeV = jet.uv * inwards.x + jet.vv * inwards.y;
  const vec3 limit = cross(changeU, jet.v) + cross(jet.u, changeV);
  const float scale = length(changeU) * length(jet.v) + length(jet.u) * length(changeV);
  if (length(limit) > kDegenerateTangents * scale && scale > kDegenerateTangents * diagonal * diagonal)
    return normalize(limit);
  rung = LIMEN_NORMAL_NONE;
  return vec3(0.0, 0.0, 1.0);
}
