// SPDX-License-Identifier: BSD-3-Clause
// First root of an algebraic surface along a pixel's ray. See algebraic.cpp.
#include "renderer/frame/seen_point.glsl"
#include "renderer/surfaces/algebraic_functions.h"
#include "renderer/techniques/ray_casting/ray_casting_bindings.h"
#include "renderer/techniques/tessellation/tessellation_bindings.h"

layout(location = 0) out uint id;
layout(location = 1) out vec4 normalAndDistance;

uniform ivec2 sizePx;
uniform vec2 rayScale;
uniform mat4 cameraToObject;  // of the surface's own coordinates, in which it lies around the origin
uniform mat4 objectToAnchor;
uniform float nearest;     // along the view
uniform float ballRadius;  // of the ball in which it is drawn
uniform int mostSteps;     // halvings of the ray's part in the ball
uniform uint material;

#ifdef COUNTING
layout(binding = kNewtonStepsImage, r32ui) uniform writeonly uimage2D stepsTaken;
#endif
uint stepCount = 0u;

// Nested loops over arrays have fixed bounds and conditions within: Mesa 22.3 gives wrong values where the inner bound
// depends on the outer counter.

#ifdef DOUBLE
#define LIMEN_REAL double
#else
#define LIMEN_REAL float
#endif

struct Interval {
  LIMEN_REAL low, high;
};
struct Gradient {
  LIMEN_REAL value;
  vec3 slope;
};

LIMEN_REAL add(LIMEN_REAL a, LIMEN_REAL b) { return a + b; }
LIMEN_REAL sub(LIMEN_REAL a, LIMEN_REAL b) { return a - b; }
LIMEN_REAL mul(LIMEN_REAL a, LIMEN_REAL b) { return a * b; }
LIMEN_REAL sqr(LIMEN_REAL a) { return a * a; }
LIMEN_REAL scale(LIMEN_REAL k, LIMEN_REAL a) { return k * a; }
LIMEN_REAL shift(LIMEN_REAL a, LIMEN_REAL k) { return a + k; }

Gradient add(Gradient a, Gradient b) { return Gradient(a.value + b.value, a.slope + b.slope); }
Gradient sub(Gradient a, Gradient b) { return Gradient(a.value - b.value, a.slope - b.slope); }
Gradient mul(Gradient a, Gradient b) {
  return Gradient(a.value * b.value, float(a.value) * b.slope + float(b.value) * a.slope);
}
Gradient sqr(Gradient a) { return mul(a, a); }
Gradient scale(LIMEN_REAL k, Gradient a) { return Gradient(k * a.value, float(k) * a.slope); }
Gradient shift(Gradient a, LIMEN_REAL k) { return Gradient(a.value + k, a.slope); }

#if ROOTS == ROOTS_INTERVALS
// Rounded to the nearest, with a margin for it.
Interval widened(LIMEN_REAL low, LIMEN_REAL high) {
  const LIMEN_REAL margin = LIMEN_REAL(2.4e-7) * max(abs(low), abs(high)) + LIMEN_REAL(1e-30);
  return Interval(low - margin, high + margin);
}
Interval add(Interval a, Interval b) { return widened(a.low + b.low, a.high + b.high); }
Interval sub(Interval a, Interval b) { return widened(a.low - b.high, a.high - b.low); }
Interval mul(Interval a, Interval b) {
  const LIMEN_REAL p = a.low * b.low, q = a.low * b.high, r = a.high * b.low, s = a.high * b.high;
  return widened(min(min(p, q), min(r, s)), max(max(p, q), max(r, s)));
}
Interval sqr(Interval a) {
  const LIMEN_REAL p = a.low * a.low, q = a.high * a.high;
  return widened(a.low <= LIMEN_REAL(0.0) && a.high >= LIMEN_REAL(0.0) ? LIMEN_REAL(0.0) : min(p, q), max(p, q));
}
Interval scale(LIMEN_REAL k, Interval a) {
  return k >= LIMEN_REAL(0.0) ? widened(k * a.low, k * a.high) : widened(k * a.high, k * a.low);
}
Interval shift(Interval a, LIMEN_REAL k) { return widened(a.low + k, a.high + k); }
LIMEN_ALGEBRAIC(Interval)
#endif

LIMEN_ALGEBRAIC(LIMEN_REAL)
LIMEN_ALGEBRAIC(Gradient)

#if SURFACE == SURFACE_SPHERE
#define VALUE sphereValue
#elif SURFACE == SURFACE_HYPERBOLOID
#define VALUE hyperboloidValue
#elif SURFACE == SURFACE_TORUS
#define VALUE torusValue
#elif SURFACE == SURFACE_GOURSAT
#define VALUE goursatValue
#elif SURFACE == SURFACE_HEART
#define VALUE heartValue
#else
#define VALUE barthDecicValue
#endif

vec3 origin = vec3(0.0), direction = vec3(0.0);  // of the ray; its origin is where it enters the ball or passes the near plane
float reach = 0.0;             // length of the ray's part in the ball

LIMEN_REAL valueAlong(LIMEN_REAL t) {
  return VALUE(LIMEN_REAL(origin.x) + LIMEN_REAL(direction.x) * t, LIMEN_REAL(origin.y) + LIMEN_REAL(direction.y) * t,
               LIMEN_REAL(origin.z) + LIMEN_REAL(direction.z) * t);
}

#if ROOTS != ROOTS_INTERVALS
// Coefficients of the polynomial on [0, reach] in Bernstein form, by interpolation.
uniform LIMEN_REAL toBernstein[(DEGREE + 1) * (DEGREE + 1)];
LIMEN_REAL coefficients[DEGREE + 1];
void interpolate() {
  LIMEN_REAL values[DEGREE + 1];
  for (int i = 0; i <= DEGREE; ++i) values[i] = valueAlong(LIMEN_REAL(reach) * LIMEN_REAL(float(i)) / LIMEN_REAL(float(DEGREE)));
  for (int i = 0; i <= DEGREE; ++i) {
    coefficients[i] = LIMEN_REAL(0.0);
    for (int j = 0; j <= DEGREE; ++j) coefficients[i] += toBernstein[i * (DEGREE + 1) + j] * values[j];
  }
}
#endif

#if ROOTS == ROOTS_BERNSTEIN
// Halves the ray until the coefficients of a part have one sign: it has no root, or until it is short: that is one.
float firstRoot() {
  interpolate();
  LIMEN_REAL part[DEGREE + 1];
  // Parts in the order of a walk through a binary tree: at depth d the part number n of 2^d.
  uint number = 0u;
  int depth = 0;
  for (int guard = 0; guard < 4096; ++guard) {
    ++stepCount;
    const LIMEN_REAL width = LIMEN_REAL(1.0) / LIMEN_REAL(float(1u << uint(depth)));
    const LIMEN_REAL from = LIMEN_REAL(float(number)) * width, to = from + width;
    for (int i = 0; i <= DEGREE; ++i) part[i] = coefficients[i];
    // The left part up to `to`, then its right part from `from`.
    for (int level = 1; level <= DEGREE; ++level)
      for (int k = 0; k < DEGREE; ++k)
        if (k <= DEGREE - level) part[DEGREE - k] += (LIMEN_REAL(1.0) - to) * (part[DEGREE - k - 1] - part[DEGREE - k]);
    const LIMEN_REAL share = from / to;
    for (int level = 1; level <= DEGREE; ++level)
      for (int i = 0; i < DEGREE; ++i)
        if (i <= DEGREE - level) part[i] += share * (part[i + 1] - part[i]);
    bool positive = false, negative = false;
    for (int i = 0; i <= DEGREE; ++i) {
      positive = positive || part[i] >= LIMEN_REAL(0.0);
      negative = negative || part[i] <= LIMEN_REAL(0.0);
    }
    if (positive && negative) {
      if (depth == mostSteps) return reach * float(LIMEN_REAL(0.5) * (from + to));
      ++depth;
      number *= 2u;
    } else {
      while (depth > 0 && (number & 1u) == 1u) {
        number >>= 1;
        --depth;
      }
      if (depth == 0) return -1.0;
      ++number;
    }
  }
  return -1.0;
}
#elif ROOTS == ROOTS_INTERVALS
float firstRoot() {
  uint number = 0u;
  int depth = 0;
  for (int guard = 0; guard < 65536; ++guard) {
    ++stepCount;
    const float width = reach / float(1u << uint(depth)), from = float(number) * width;
    const LIMEN_REAL margin = LIMEN_REAL(2.4e-7) * LIMEN_REAL(reach + ballRadius);
    LIMEN_REAL low[3], high[3];
    for (int axis = 0; axis < 3; ++axis) {
      const LIMEN_REAL a = LIMEN_REAL(origin[axis] + direction[axis] * from),
                       b = LIMEN_REAL(origin[axis] + direction[axis] * (from + width));
      low[axis] = min(a, b) - margin;
      high[axis] = max(a, b) + margin;
    }
    const Interval value = VALUE(Interval(low[0], high[0]), Interval(low[1], high[1]), Interval(low[2], high[2]));
    if (value.low <= LIMEN_REAL(0.0) && value.high >= LIMEN_REAL(0.0)) {
      if (depth == mostSteps) return from + 0.5 * width;
      ++depth;
      number *= 2u;
    } else {
      while (depth > 0 && (number & 1u) == 1u) {
        number >>= 1;
        --depth;
      }
      if (depth == 0) return -1.0;
      ++number;
    }
  }
  return -1.0;
}
#else
// Closed formulas of degree 2 and 4 (Loop and Blinn 2006 for the latter; here by Ferrari's resolvent).
float least = -1.0;
void consider(float t) {
  if (t >= 0.0 && t <= reach && (least < 0.0 || t < least)) least = t;
}
void quadratic(float b, float c, float offset) {  // t^2 + b t + c
  const float q = 0.25 * b * b - c;
  if (!(q >= 0.0)) return;
  const float root = sqrt(q);
  consider(-0.5 * b - root + offset);
  consider(-0.5 * b + root + offset);
}
float firstRoot() {
  ++stepCount;
  interpolate();
  // Monomials of s = t / reach from the Bernstein form, by differences.
  float m[DEGREE + 1];
  for (int i = 0; i <= DEGREE; ++i) m[i] = float(coefficients[i]);
  for (int level = 1; level <= DEGREE; ++level)
    for (int k = 0; k < DEGREE; ++k)
      if (k <= DEGREE - level) m[DEGREE - k] -= m[DEGREE - k - 1];
#if DEGREE == 2
  m[1] *= 2.0;
  const float scale_ = reach / m[2];
  quadratic(m[1] * scale_, m[0] * scale_ * reach, 0.0);
#else
  const float a = 4.0 * m[3] / m[4], b = 6.0 * m[2] / m[4], c = 4.0 * m[1] / m[4], d = m[0] / m[4];
  // y^4 + p y^2 + q y + r with s = y - a / 4.
  const float aa = a * a, p = b - 0.375 * aa, q = c - 0.5 * a * b + 0.125 * aa * a,
              r = d - 0.25 * a * c + aa * b / 16.0 - 3.0 * aa * aa / 256.0;
  // A positive root of z^3 + 2 p z^2 + (p^2 - 4 r) z - q^2.
  const float third = 2.0 * p / 3.0, cp = (p * p - 4.0 * r) - 3.0 * third * third,
              cq = -third * third * third + 2.0 * p * third * third - (p * p - 4.0 * r) * third - q * q;
  const float disc = 0.25 * cq * cq + cp * cp * cp / 27.0;
  float z;
  if (disc >= 0.0) {
    const float root = sqrt(disc), u = -0.5 * cq + (cq > 0.0 ? -root : root);
    const float k = sign(u) * pow(abs(u), 1.0 / 3.0);
    z = (k != 0.0 ? k - cp / (3.0 * k) : 0.0) - third;
  } else {
    const float radius = sqrt(-cp / 3.0);
    z = 2.0 * radius * cos(acos(clamp(-0.5 * cq / (radius * radius * radius), -1.0, 1.0)) / 3.0) - third;
  }
  z = max(z, 0.0);
  const float w = sqrt(z);
  float s = w > 0.0 ? 0.5 * q / w : 0.0;
  if (!(w > 0.0)) s = sqrt(max(0.25 * p * p - r, 0.0));
  const float middle = 0.5 * (p + z), stretch = reach;
  const float keep = reach;
  reach = 1.0;
  quadratic(w, middle - s, -0.25 * a);
  quadratic(-w, middle + s, -0.25 * a);
  reach = keep;
  if (least >= 0.0) least *= stretch;
#endif
  return least;
}
#endif

void main() {
  const vec3 inCamera = placeRay(gl_FragCoord.xy, rayScale, sizePx);
  const vec3 eye = cameraToObject[3].xyz, perDistance = mat3(cameraToObject) * inCamera;
  const float perUnit = length(perDistance);
  direction = perDistance / perUnit;
  const float middle = -dot(eye, direction);
  const vec3 closest = eye + middle * direction;
  const float half_ = ballRadius * ballRadius - dot(closest, closest);
  if (!(half_ > 0.0)) discard;
  const float start = max(middle - sqrt(half_), nearest * perUnit), end = middle + sqrt(half_);
  if (!(end > start)) discard;
  origin = closest + (start - middle) * direction;
  reach = end - start;
  const float t = firstRoot();
#ifdef COUNTING
  imageStore(stepsTaken, ivec2(gl_FragCoord.xy), uvec4(stepCount));
#endif
  if (!(t >= 0.0)) discard;
  const vec3 at = origin + t * direction;
  const Gradient gradient = VALUE(Gradient(LIMEN_REAL(at.x), vec3(1.0, 0.0, 0.0)), Gradient(LIMEN_REAL(at.y), vec3(0.0, 1.0, 0.0)),
                                  Gradient(LIMEN_REAL(at.z), vec3(0.0, 0.0, 1.0)));
  vec3 normal = gradient.slope;
  if (dot(normal, direction) > 0.0) normal = -normal;
  const float distance_ = (start + t) / perUnit;
  id = kSurfaceOfPatch | material;
  normalAndDistance = vec4(mat3(objectToAnchor) * normal, distance_);
  gl_FragDepth = nearest / distance_;
}
