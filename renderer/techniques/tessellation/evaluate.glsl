// SPDX-License-Identifier: BSD-3-Clause
// Points and normals of patches at samples of a pattern. Terms of mirrored control points are added first, and a
// parameter's distance from 1 is a number of its own, so that patches with a common side get bitwise the same
// points along it, in whichever direction each of them runs (Schwarz 2009, section 7.3.1; SC-05).
#include "renderer/techniques/tessellation/patches.glsl"

layout(std430, binding = kPatchNormalsBuffer) readonly buffer PatchNormals { vec4 patchNormals[]; };

#ifdef SHAPE
const int kBasis = int(max(uint(SHAPE) >> 1 & 15u, uint(SHAPE) >> 5 & 15u)) + 1;
#else
const int kBasis = 10;
#endif

// Binomial coefficients, rows of n = 0 to 9.
const float kBinomials[55] = float[55](
    1.0,
    1.0, 1.0,
    1.0, 2.0, 1.0,
    1.0, 3.0, 3.0, 1.0,
    1.0, 4.0, 6.0, 4.0, 1.0,
    1.0, 5.0, 10.0, 10.0, 5.0, 1.0,
    1.0, 6.0, 15.0, 20.0, 15.0, 6.0, 1.0,
    1.0, 7.0, 21.0, 35.0, 35.0, 21.0, 7.0, 1.0,
    1.0, 8.0, 28.0, 56.0, 70.0, 56.0, 28.0, 8.0, 1.0,
    1.0, 9.0, 36.0, 84.0, 126.0, 126.0, 84.0, 36.0, 9.0, 1.0);
float binomial(int n, int i) { return kBinomials[n * (n + 1) / 2 + i]; }

// A point of the domain. `rest`: 1 - u, 1 - v; of a triangle x is w.
struct DomainPoint {
  vec2 at, rest;
};

DomainPoint domainPoint(uint shape, ivec4 s) {
  DomainPoint point;
  if (isRectangle(shape)) {
    point.at = vec2(s.xz) / vec2(s.yw);
    point.rest = vec2(s.yw - s.xz) / vec2(s.yw);
  } else {
    point.at = vec2(s.xy) / float(s.w);
    point.rest = vec2(float(s.z) / float(s.w), 0.0);
  }
  return point;
}

// B_i^n and their derivatives.
void bernstein(int n, float t, float s, out float basis[kBasis], out float slope[kBasis]) {
  precise float a[kBasis];
  precise float b[kBasis];
  a[0] = 1.0;
  b[0] = 1.0;
  for (int i = 1; i <= n; ++i) {
    a[i] = a[i - 1] * t;
    b[i] = b[i - 1] * s;
  }
  for (int i = 0; i <= n; ++i) {
    precise const float value = binomial(n, i) * (a[i] * b[n - i]);
    basis[i] = value;
    float rise = 0.0;
    if (i > 0) rise += binomial(n - 1, i - 1) * a[i - 1] * b[n - i];
    if (i < n) rise -= binomial(n - 1, i) * a[i] * b[n - 1 - i];
    slope[i] = float(n) * rise;
  }
}

struct SurfaceJet {
  vec4 p, u, v;  // homogeneous
};

// Row of a rectangle: value and derivative along u.
void rowAt(int first, int n, float basis[kBasis], float slope[kBasis], out vec4 value, out vec4 rise) {
  precise vec4 sum = vec4(0.0);
  rise = vec4(0.0);
  for (int i = 0; 2 * i < n; ++i) {
    const vec4 low = patchPoints[first + i], high = patchPoints[first + n - i];
    precise const vec4 pair = low * basis[i] + high * basis[n - i];
    sum = i == 0 ? pair : sum + pair;
    rise += low * slope[i] + high * slope[n - i];
  }
  if ((n & 1) == 0) {
    const vec4 middle = patchPoints[first + n / 2];
    precise const vec4 term = middle * basis[n / 2];
    sum = n == 0 ? term : sum + term;
    rise += middle * slope[n / 2];
  }
  value = sum;
}

SurfaceJet rectangleJet(int first, uint shape, DomainPoint point) {
  const int m = degreeU(shape), n = degreeV(shape);
  float bu[kBasis], du[kBasis], bv[kBasis], dv[kBasis];
  bernstein(m, point.at.x, point.rest.x, bu, du);
  bernstein(n, point.at.y, point.rest.y, bv, dv);
  SurfaceJet jet;
  precise vec4 sum = vec4(0.0);
  jet.u = vec4(0.0);
  jet.v = vec4(0.0);
  for (int j = 0; 2 * j < n; ++j) {
    vec4 low, high, lowRise, highRise;
    rowAt(first + j * (m + 1), m, bu, du, low, lowRise);
    rowAt(first + (n - j) * (m + 1), m, bu, du, high, highRise);
    precise const vec4 pair = low * bv[j] + high * bv[n - j];
    sum = j == 0 ? pair : sum + pair;
    jet.u += lowRise * bv[j] + highRise * bv[n - j];
    jet.v += low * dv[j] + high * dv[n - j];
  }
  if ((n & 1) == 0) {
    vec4 middle, rise;
    rowAt(first + n / 2 * (m + 1), m, bu, du, middle, rise);
    precise const vec4 term = middle * bv[n / 2];
    sum = sum + term;
    jet.u += rise * bv[n / 2];
    jet.v += middle * dv[n / 2];
  }
  jet.p = sum;
  return jet;
}

float power(float x, int n) {
  float out_ = 1.0;
  for (int i = 0; i < n; ++i) out_ *= x;
  return out_;
}

// B_ijk^n at u, v, w.
float triangleBasis(int n, int i, int j, int k, vec3 at) {
  return binomial(n, i) * binomial(n - i, k) * power(at.x, i) * power(at.y, j) * power(at.z, k);
}

SurfaceJet triangleJet(int first, int n, DomainPoint point) {
  const vec3 at = vec3(point.at, point.rest.x);
  SurfaceJet jet;
  jet.p = vec4(0.0);
  jet.u = vec4(0.0);
  jet.v = vec4(0.0);
  for (int i = 0; i <= n; ++i)
    for (int k = 0; i + k <= n; ++k) {
      jet.p += patchPoints[first + trianglePlace(n, i, k)] * triangleBasis(n, i, n - i - k, k, at);
      if (i + k < n) {
        const float weight = float(n) * triangleBasis(n - 1, i, n - 1 - i - k, k, at);
        const vec4 w = patchPoints[first + trianglePlace(n, i, k + 1)];
        jet.u += (patchPoints[first + trianglePlace(n, i + 1, k)] - w) * weight;
        jet.v += (patchPoints[first + trianglePlace(n, i, k)] - w) * weight;
      }
    }
  // Along a side, exactly as a rectangle computes its own.
  if (at.x == 0.0 || at.y == 0.0 || at.z == 0.0) {
    const int side = at.z == 0.0 ? 0 : (at.x == 0.0 ? 1 : 2);
    float basis[kBasis], slope[kBasis];
    // From the side's second corner, in which direction the sums do not differ.
    const float t = side == 0 ? at.y : (side == 1 ? at.z : at.x), s = side == 0 ? at.x : (side == 1 ? at.y : at.z);
    bernstein(n, t, s, basis, slope);
    precise vec4 sum = vec4(0.0);
    for (int a = 0; 2 * a <= n; ++a) {
      const int b = n - a;
      const int low = side == 0 ? trianglePlace(n, b, 0) : (side == 1 ? trianglePlace(n, 0, a) : trianglePlace(n, a, b));
      const int high = side == 0 ? trianglePlace(n, a, 0) : (side == 1 ? trianglePlace(n, 0, b) : trianglePlace(n, b, a));
      precise vec4 term = patchPoints[first + low] * basis[a];
      if (a != b) term = term + patchPoints[first + high] * basis[b];
      sum = a == 0 ? term : sum + term;
    }
    jet.p = sum;
  }
  return jet;
}

SurfaceJet surfaceJet(TessellatedPatch patch_, DomainPoint point) {
  const uint shape = shapeOf(patch_);
  if (isRectangle(shape)) return rectangleJet(int(patch_.firstPoint), shape, point);
  return triangleJet(int(patch_.firstPoint), degreeU(shape), point);
}

// Directions of the derivatives of the projected surface, both times w^2; (0, 0, 0, 0) where they are degenerate.
vec3 crossOf(SurfaceJet jet, out bool degenerate) {
  const vec3 a = jet.p.w * jet.u.xyz - jet.u.w * jet.p.xyz, b = jet.p.w * jet.v.xyz - jet.v.w * jet.p.xyz;
  const float longest = max(max(abs(a.x), max(abs(a.y), abs(a.z))), max(abs(b.x), max(abs(b.y), abs(b.z))));
  degenerate = true;
  if (!(longest > 0.0)) return vec3(0.0);
  const vec3 c = a / longest, d = b / longest, n = cross(c, d);
  const float cc = dot(c, c), dd = dot(d, d), least = 1e-10;
  degenerate = !(dot(n, n) > least * cc * dd && cc > least && dd > least);
  return n;
}

vec3 fieldNormal(TessellatedPatch patch_, int n, DomainPoint point) {
  const vec3 at = vec3(point.at, point.rest.x);
  vec3 sum = vec3(0.0);
  for (int i = 0; i <= n; ++i)
    for (int k = 0; i + k <= n; ++k)
      sum += patchNormals[int(patch_.firstNormal) + trianglePlace(n, i, k)].xyz *
             triangleBasis(n, i, n - i - k, k, at);
  return sum;
}

// As a vertex of the picture.
TessellatedVertex surfaceVertex(TessellatedPatch patch_, DomainPoint point) {
  const uint shape = shapeOf(patch_);
  const SurfaceJet jet = surfaceJet(patch_, point);
  precise const vec3 position = jet.p.xyz / jet.p.w;
  TessellatedVertex vertex;
  vertex.position = position;
  vertex.material = patch_.material;
  vertex.rung = kRungTangents;
  bool degenerate = false;
  vec3 normal = vec3(0.0);
  if (normalDegree(shape) > 0) {
    normal = fieldNormal(patch_, normalDegree(shape), point);
    degenerate = !(dot(normal, normal) > 1e-20);
    vertex.rung = kRungField;
  }
  if (normalDegree(shape) == 0 || degenerate) {
    normal = crossOf(jet, degenerate);
    vertex.rung = kRungTangents;
    if (degenerate) {
      DomainPoint inside = point;
      const float eta = 1e-3;  // domain units
      if (isRectangle(shape)) {
        inside.at = mix(point.at, vec2(0.5), 2.0 * eta);
        inside.rest = 1.0 - inside.at;
      } else {
        inside.at = mix(point.at, vec2(1.0 / 3.0), 3.0 * eta);
        inside.rest.x = 1.0 - inside.at.x - inside.at.y;
      }
      normal = crossOf(surfaceJet(patch_, inside), degenerate);
      vertex.rung = kRungInward;
    }
    if (degenerate) {
      const int first = int(patch_.firstPoint), m = degreeU(shape), n = degreeV(shape);
      const int last = pointCount(shape) - 1;
      const vec4 a = patchPoints[first], b = patchPoints[first + (isRectangle(shape) ? m : last - m)],
                 c = patchPoints[first + last],
                 d = isRectangle(shape) ? patchPoints[first + n * (m + 1)] : patchPoints[first];
      normal = isRectangle(shape) ? cross(c.xyz / c.w - a.xyz / a.w, d.xyz / d.w - b.xyz / b.w)
                                  : cross(b.xyz / b.w - a.xyz / a.w, c.xyz / c.w - a.xyz / a.w);
      vertex.rung = kRungCornerPlane;
    }
  }
  const float reach = max(abs(normal.x), max(abs(normal.y), abs(normal.z)));
  if (reach > 0.0) {
    vertex.normal = normalize(normal / reach);
  } else {
    vertex.normal = vec3(0.0, 0.0, 1.0);
    vertex.rung = kRungNone;
  }
  return vertex;
}
