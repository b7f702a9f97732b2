// SPDX-License-Identifier: BSD-3-Clause
// Reflection point of a vertex on a star-shaped reflector by a secant method with three samples. See secant_solver.h,
// whose twin in single precision this is, and Roger 2008, section 2.2. Lengths within are over the reflector's mean
// radius and relative to its centre. Defines: CAP, GRADIENT, GUESS, SAFEGUARD, STOP with the names of enumerations.
#include "renderer/techniques/reflections/vertex_reflection/vertex_reflection_bindings.h"

#ifdef MAP_LAT_LONG
layout(binding = kReflectorMapUnit) uniform sampler2D reflectorMap;
#else
layout(binding = kReflectorMapUnit) uniform samplerCube reflectorMap;
#endif

#ifdef MAP_LAT_LONG
layout(binding = kReflectorPresentUnit) uniform sampler2D reflectorPresent;
#else
layout(binding = kReflectorPresentUnit) uniform samplerCube reflectorPresent;
#endif

uniform int openMirror;  // 1: its map was filled where the surface ends
uniform vec3 reflectorCentre;  // relative to the scene's anchor
uniform float reflectorUnit;   // mean radius
uniform float mirrorSide;      // 1: the mirror faces outward; -1: inward
uniform vec3 solverEye;        // in the reflector's units
uniform mat4 reflectorToClip;  // from the reflector's units
uniform vec2 halfSizePx;
uniform float stopAreaPx2, determinantShare, leastSide, falseRootLength;

struct PathSample {
  vec3 point, gradient;
  float length;
};

vec3 unitOr(vec3 v, vec3 otherwise) {
  const float reach = max(abs(v.x), max(abs(v.y), abs(v.z)));
  return reach > 1e-30 && reach < 1e30 ? normalize(v / reach) : otherwise;
}

#ifdef MAP_LAT_LONG
vec2 mapPlace(vec3 u) {
  const float kPi = 3.14159265358979;
  return vec2(atan(u.y, u.x) / (2.0 * kPi), acos(clamp(u.z, -1.0, 1.0)) / kPi);
}
#else
vec3 mapPlace(vec3 u) { return u; }
#endif

// Radius and its gradient; 0 for what is no direction, for which a driver may read anywhere.
vec4 radialPoint(vec3 u) {
  if (any(isnan(u)) || any(isinf(u)) || u == vec3(0.0)) return vec4(0.0);
  return textureLod(reflectorMap, mapPlace(u), 0.0);
}

// Whether an open mirror, seen from within, lies between its point and a vertex: where the segment leaves the surface
// continued, is there surface?
bool behindOwnWall(vec3 point, vec3 vertex) {
  const int kSteps = 16;
  for (int i = 1; i <= kSteps; ++i) {
    const vec3 at = mix(point, vertex, float(i) / float(kSteps));
    const vec3 u = unitOr(at, vec3(0.0, 0.0, 1.0));
    // The first steps are along the surface.
    if (dot(at, u) > radialPoint(u).x * 1.001) return textureLod(reflectorPresent, mapPlace(u), 0.0).x > 0.5;
  }
  return false;
}

vec3 anyTangent(vec3 u) { return normalize(cross(u, abs(u.x) < 0.6 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0))); }

PathSample pathSample(vec3 u, vec3 vertex) {
  const vec4 at = radialPoint(u);
  PathSample s;
  s.point = at.x * u;
  const vec3 fromEye = unitOr(s.point - solverEye, vec3(0.0)), fromVertex = unitOr(s.point - vertex, vec3(0.0));
#if GRADIENT == GRADIENT_PRINTED
  const vec3 e = fromVertex - fromEye;
#else
  const vec3 e = fromEye + fromVertex;
#endif
  const vec3 across = e - dot(u, e) * u;
#if GRADIENT == GRADIENT_CORRECTED
  s.gradient = across + dot(u, e) * at.yzw;
#else
  s.gradient = across + dot(at.yzw, e) * u;
#endif
  s.length = length(s.gradient);
  if (!(at.x > 0.0) || !(s.length < 1e30)) s.length = 1e30;
  return s;
}

// Positions in the picture, in pixels from its middle; false behind the viewer.
bool placeOf(vec3 point, out vec2 place) {
  const vec4 clip = reflectorToClip * vec4(point, 1.0);
  place = clip.xy / clip.w * halfSizePx;
  return clip.w > 0.0;
}

// Area, or half the square of the longest side.
float projectedSize(PathSample a, PathSample b, PathSample c) {
  vec2 pa, pb, pc;
  const bool ok = placeOf(a.point, pa) && placeOf(b.point, pb) && placeOf(c.point, pc);
  const vec2 u = pb - pa, v = pc - pa;
  if (!ok) return 1e30;
#if STOP == STOP_LONGEST_SIDE
  const vec2 w = v - u;
  return 0.5 * max(dot(u, u), max(dot(v, v), dot(w, w)));
#else
  return 0.5 * abs(u.x * v.y - u.y * v.x);
#endif
}

void triangleAround(vec3 middle, float side, out vec3 first, out vec3 second, out vec3 third) {
  const vec3 x = anyTangent(middle), y = cross(middle, x);
  const float reach = side * 0.57735027;
  first = normalize(middle + reach * x);
  second = normalize(middle + reach * (-0.5 * x + 0.8660254 * y));
  third = normalize(middle + reach * (-0.5 * x - 0.8660254 * y));
}

void projections(vec3 vertex, out vec3 a, out vec3 b, out vec3 c) {
  b = unitOr(solverEye, vec3(0.0, 0.0, 1.0));
  a = unitOr(vertex, b);
  if (length(a - b) < leastSide) {
    const vec3 aside = cross(b, unitOr(cross(a, b), anyTangent(b)));
    a = normalize(b + leastSide * aside);
  }
  const vec3 middle = 0.5 * (a + b), t = unitOr(cross(b - a, middle), anyTangent(b));
  c = unitOr(middle + 0.8660254 * length(a - b) * t, t);
}

// From three directions; the point's status without outcome, and whether it is converged.
PathSample secant(vec3 vertex, vec3 first, vec3 second, vec3 third, inout uint iterations, inout uint exchanges,
                  out bool converged) {
  PathSample s[3];
  s[0] = pathSample(first, vertex);
  s[1] = pathSample(second, vertex);
  s[2] = pathSample(third, vertex);
  int newest = 2;
  PathSample discarded = s[0], best = s[0];
  bool hasDiscarded = false;
  for (int i = 1; i < 3; ++i)
    if (s[i].length < best.length) best = s[i];
  converged = projectedSize(s[0], s[1], s[2]) < stopAreaPx2;
  for (int step = 0; step < CAP && !converged; ++step) {
    ++iterations;
    const vec3 a = s[0].gradient - s[2].gradient, b = s[1].gradient - s[2].gradient, c = s[2].gradient;
    const float aa = dot(a, a), bb = dot(b, b), ab = dot(a, b), determinant = aa * bb - ab * ab;
    if (!(determinant > determinantShare * aa * bb) && hasDiscarded) {
      int at = newest == 0 ? 1 : 0;
      for (int i = 0; i < 3; ++i)
        if (i != newest && s[i].length > s[at].length) at = i;
      const PathSample swapped = s[at];
      s[at] = discarded;
      discarded = swapped;
      newest = at;
      ++exchanges;
    } else {
      const float ac = dot(a, c), bc = dot(b, c);
      const float alpha = (ab * bc - bb * ac) / determinant, beta = (ab * ac - aa * bc) / determinant;
      const vec3 d = alpha * s[0].point + beta * s[1].point + (1.0 - alpha - beta) * s[2].point;
      const float reach = max(abs(d.x), max(abs(d.y), abs(d.z)));
      if (!(reach > 1e-20 && reach < 1e20)) continue;
      int at = 0;
      for (int i = 1; i < 3; ++i)
        if (!(s[i].length <= s[at].length)) at = i;
      discarded = s[at];
      hasDiscarded = true;
      s[at] = pathSample(normalize(d / reach), vertex);
      newest = at;
      if (s[at].length < best.length) best = s[at];
    }
    converged = projectedSize(s[0], s[1], s[2]) < stopAreaPx2;
  }
#if SAFEGUARD == SAFEGUARD_NONE
  best = s[0];
  for (int i = 1; i < 3; ++i)
    if (s[i].length < best.length) best = s[i];
#endif
  return best;
}

uint outcomeOf(PathSample found, vec3 vertex, bool converged) {
  if (!(found.length < 1e30)) return kOutcomeNoSurface;
  const vec3 u = normalize(found.point), normal = mirrorSide * (u - radialPoint(u).yzw);
  const vec3 toEye = solverEye - found.point, toVertex = vertex - found.point;
  if (length(unitOr(toEye, vec3(0.0)) + unitOr(toVertex, vec3(0.0))) < falseRootLength) return kOutcomeFalseRoot;
  if (!(dot(normal, toEye) > 0.0) || !(dot(normal, toVertex) >= 0.0)) return kOutcomeFacingAway;
  if (openMirror != 0 && mirrorSide < 0.0 && behindOwnWall(found.point, vertex)) return kOutcomeFacingAway;
  return converged ? kOutcomeFound : kOutcomeUnconverged;
}

// `position` relative to the scene's anchor; `previous`: the vertex as solved a frame ago, all 0 if it was not. The
// reflection point, likewise relative, and its status.
vec4 reflectedVertex(vec3 position, vec4 previous) {
  const vec3 vertex = (position - reflectorCentre) / reflectorUnit;
  uint iterations = 0u, exchanges = 0u, flags = 0u;
  bool converged = false;
  vec3 first, second, third;
#if GUESS != GUESS_PROJECTIONS
  triangleAround(unitOr(mirrorSide * solverEye, vec3(0.0, 0.0, 1.0)), 10.0 * leastSide, first, second, third);
#else
  projections(vertex, first, second, third);
#endif
#if GUESS == GUESS_PREVIOUS_FRAME
  if ((floatBitsToUint(previous.w) & kStatusUsable) != 0u)
    triangleAround(unitOr(previous.xyz - reflectorCentre, first), leastSide, first, second, third);
#endif
  PathSample found = secant(vertex, first, second, third, iterations, exchanges, converged);
  uint outcome = outcomeOf(found, vertex, converged);
#if SAFEGUARD == SAFEGUARD_RESTART && GUESS != GUESS_FACING_EYE
  if (outcome != kOutcomeFound && outcome != kOutcomeFalseRoot) {
    triangleAround(unitOr(mirrorSide * solverEye, vec3(0.0, 0.0, 1.0)), 10.0 * leastSide, first, second, third);
    const PathSample other = secant(vertex, first, second, third, iterations, exchanges, converged);
    const uint otherOutcome = outcomeOf(other, vertex, converged);
    if (otherOutcome <= outcome) {
      found = other;
      outcome = otherOutcome;
    }
    flags |= kStatusRestarted;
  }
#endif
  if (outcome != kOutcomeNoSurface) flags |= kStatusUsable;
  const uint status = min(iterations, 255u) | min(exchanges, 255u) << 8 | outcome << kStatusOutcomeShift | flags;
  return vec4(outcome == kOutcomeNoSurface ? reflectorCentre : reflectorCentre + reflectorUnit * found.point,
              uintBitsToFloat(status | 0x40000000u));
}

uint statusOf(vec4 reflected) { return floatBitsToUint(reflected.w) & 0x00ffffffu; }
uint outcomeOfStatus(uint status) { return status >> kStatusOutcomeShift & 7u; }
