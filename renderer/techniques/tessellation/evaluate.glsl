// SPDX-License-Identifier: BSD-3-Clause
// Vertices of patches at samples of a pattern. Patches with a common side get bitwise the same points along it, in
// whichever direction each of them runs (bezier.glsl; Schwarz 2009, section 7.3.1; SC-05).
// POLYNOMIAL: all weights are 1.
#include "renderer/surfaces/spacing.h"
#include "renderer/techniques/tessellation/patches.glsl"

layout(std430, binding = kPatchNormalsBuffer) readonly buffer PatchNormals { vec4 patchNormals[]; };

int patchFirst = 0;  // first control point of the patch that is evaluated
vec4 bezierPoint(int index) { return patchPoints[patchFirst + index]; }
#ifdef POLYNOMIAL
#define LIMEN_POLYNOMIAL
#endif
#include "renderer/surfaces/bezier.glsl"

bool isBicubic(uint shape) { return isRectangle(shape) && degreeU(shape) == 3 && degreeV(shape) == 3; }

// (u, v, 1 - u, 1 - v) of a rectangle, (u, v, w, 0) of a triangle.
vec4 domainPoint(uint shape, ivec4 s) {
  return isRectangle(shape) ? rectangleGridPoint(s.x, s.y, s.z, s.w) : triangleGridPoint(s.x, s.y, s.w);
}

// The same of real factors. `units`: of the sides.
vec4 spacedPoint(uint shape, ivec4 s, int spacing, ivec4 units) {
  if (!isRectangle(shape)) return domainPoint(shape, s);
  const int side = sideOfSample(1, s), alongU = unitsAlong(units, side, 0), alongV = unitsAlong(units, side, 1);
  return vec4(spacedPlace(spacing, alongU, s.x, s.y), spacedPlace(spacing, alongV, s.z, s.w),
              spacedPlace(spacing, alongU, s.y - s.x, s.y), spacedPlace(spacing, alongV, s.w - s.z, s.w));
}

// bezierTriangle(3, at, 1) without loops.
vec4 quadraticTriangleSum(vec3 at, vec4 a, vec4 b, vec4 c, vec4 d, vec4 e, vec4 f) {
  return (a * (at.x * at.x) + d * (at.y * at.y) + f * (at.z * at.z)) +
         2.0 * (b * (at.x * at.y) + e * (at.y * at.z) + c * (at.x * at.z));
}
BezierJet cubicTriangleJet(vec4 at) {
  vec4 c[10];
  for (int k = 0; k < 10; ++k) c[k] = bezierPoint(k);
  const vec4 u = quadraticTriangleSum(at.xyz, c[0] - c[2], c[1] - c[4], c[2] - c[5], c[3] - c[7], c[4] - c[8], c[5] - c[9]);
  const vec4 v = quadraticTriangleSum(at.xyz, c[1] - c[2], c[3] - c[4], c[4] - c[5], c[6] - c[7], c[7] - c[8], c[8] - c[9]);
  return BezierJet(cubicTriangleSum(at, c), 3.0 * u, 3.0 * v, vec4(0.0), vec4(0.0), vec4(0.0));
}

BezierJet jetAt(TessellatedPatch patch_, vec4 at) {
  const uint shape = shapeOf(patch_);
  patchFirst = int(patch_.firstPoint);
  if (isBicubic(shape)) return bezierBicubic(at);
  if (isRectangle(shape)) return bezierRectangle(degreeU(shape), degreeV(shape), at, 1);
  if (degreeU(shape) == 3) return cubicTriangleJet(at);
  return bezierTriangle(degreeU(shape), at, 1);
}

vec3 positionOf(vec4 point) {
#ifdef POLYNOMIAL
  return point.xyz;
#else
  return bezierPosition(point);
#endif
}

// Normal of the projected surface, of any length; whether the derivatives give none.
vec3 acrossTangents(BezierJet jet, out bool degenerate) {
#ifdef POLYNOMIAL
  const vec3 a = jet.u.xyz, b = jet.v.xyz;
#else
  const vec3 a = jet.p.w * jet.u.xyz - jet.u.w * jet.p.xyz, b = jet.p.w * jet.v.xyz - jet.v.w * jet.p.xyz;
#endif
  const vec3 n = cross(a, b);
  const float aa = dot(a, a), bb = dot(b, b), least = 1e-10;
  // What rounding leaves of a tangent of length 0: points lie far from the anchor, compared with the patch's size.
  const float noise = 2e-6 * abs(jet.p.w) * length(jet.p.xyz);
  degenerate = !(dot(n, n) > least * aa * bb && aa > least * bb && bb > least * aa && min(aa, bb) > noise * noise);
  return n;
}

vec3 fieldNormal(TessellatedPatch patch_, int n, vec4 at) {
  const int first = int(patch_.firstNormal);
  if (n == 3) {  // a rectangle's, of degree 5
    float u[10], v[10];
    bernsteinBasis(5, at.x, at.z, u);
    bernsteinBasis(5, at.y, at.w, v);
    vec3 sum = vec3(0.0);
    for (int j = 0; j <= 5; ++j)
      for (int i = 0; i <= 5; ++i) sum += u[i] * v[j] * patchNormals[first + i + 6 * j].xyz;
    return sum;
  }
  if (n == 1)
    return patchNormals[first].xyz * at.x + patchNormals[first + 1].xyz * at.y + patchNormals[first + 2].xyz * at.z;
  vec3 points[6];
  for (int i = 0; i < 6; ++i) points[i] = patchNormals[first + i].xyz;
  return quadraticTriangleField(at, points);
}

// Where the derivatives give no normal: theirs a little way inside, else that of the corners. (SC-04)
vec3 normalInside(TessellatedPatch patch_, vec4 at, out uint rung) {
  const uint shape = shapeOf(patch_);
  const float eta = 1e-3;  // domain units
  vec4 inside = vec4(0.0);
  if (isRectangle(shape)) {
    inside.xy = mix(at.xy, vec2(0.5), 2.0 * eta);
    inside.zw = 1.0 - inside.xy;
  } else {
    inside.xy = mix(at.xy, vec2(1.0 / 3.0), 3.0 * eta);
    inside.z = 1.0 - inside.x - inside.y;
  }
  bool degenerate;
  const vec3 normal = acrossTangents(jetAt(patch_, inside), degenerate);
  rung = kRungInward;
  if (!degenerate) return normal;
  rung = kRungCornerPlane;
  const int first = int(patch_.firstPoint), m = degreeU(shape), n = degreeV(shape), last = pointCount(shape) - 1;
  const vec4 a = patchPoints[first], b = patchPoints[first + (isRectangle(shape) ? m : last - m)],
             c = patchPoints[first + last], d = isRectangle(shape) ? patchPoints[first + n * (m + 1)] : patchPoints[first];
  return isRectangle(shape) ? cross(c.xyz / c.w - a.xyz / a.w, d.xyz / d.w - b.xyz / b.w)
                            : cross(b.xyz / b.w - a.xyz / a.w, c.xyz / c.w - a.xyz / a.w);
}

TessellatedVertex vertexWith(TessellatedPatch patch_, vec4 point, vec3 normal, uint rung) {
  TessellatedVertex vertex;
  vertex.position = positionOf(point);
  vertex.material = patch_.material;
  const float reach = max(abs(normal.x), max(abs(normal.y), abs(normal.z)));
  vertex.normal = reach > 0.0 ? normalize(normal / reach) : vec3(0.0, 0.0, 1.0);
  vertex.rung = reach > 0.0 ? rung : kRungNone;
  return vertex;
}

// From the value and derivatives at a point.
TessellatedVertex vertexOf(TessellatedPatch patch_, vec4 at, BezierJet jet) {
  const int field = normalDegree(shapeOf(patch_));
  if (field > 0) {
    const vec3 given = fieldNormal(patch_, field, at);
    if (dot(given, given) > 1e-20) return vertexWith(patch_, jet.p, given, kRungField);
  }
  bool degenerate;
  vec3 normal = acrossTangents(jet, degenerate);
  uint rung = kRungTangents;
  if (degenerate) normal = normalInside(patch_, at, rung);
  return vertexWith(patch_, jet.p, normal, rung);
}

TessellatedVertex surfaceVertex(TessellatedPatch patch_, vec4 at) {
  const int field = normalDegree(shapeOf(patch_));
  if (field > 0) {
    const vec3 normal = fieldNormal(patch_, field, at);
    if (dot(normal, normal) > 1e-20) return vertexWith(patch_, jetAt(patch_, at).p, normal, kRungField);
  }
  return vertexOf(patch_, at, jetAt(patch_, at));
}

// Corner (0: u = 1, 1: v = 1, 2: w = 1) of a triangle with a normal field: all that one with factors of 1 needs.
TessellatedVertex triangleCorner(TessellatedPatch patch_, int corner) {
  const int n = degreeU(shapeOf(patch_)), m = normalDegree(shapeOf(patch_));
  const int place = corner == 0 ? 0 : (corner == 1 ? trianglePlace(n, 0, 0) : trianglePlace(n, 0, n));
  const int normalPlace = corner == 0 ? 0 : (corner == 1 ? trianglePlace(m, 0, 0) : trianglePlace(m, 0, m));
  const vec4 point = patchPoints[int(patch_.firstPoint) + place];
  TessellatedVertex vertex;
  vertex.position = positionOf(point);
  vertex.material = patch_.material;
  const vec3 normal = patchNormals[int(patch_.firstNormal) + normalPlace].xyz;
  const bool has = dot(normal, normal) > 1e-20;
  vertex.normal = has ? normalize(normal) : vec3(0.0, 0.0, 1.0);
  vertex.rung = has ? kRungField : kRungNone;
  return vertex;
}
