// SPDX-License-Identifier: BSD-3-Clause
// A walk along a curve of constant v on a bicubic patch, a point for each pixel that it passes; curves are evenly spaced.
#include "renderer/techniques/isocurves/isocurve_points.glsl"

#ifdef COUNTING
// How far a point by differences lies from the curve's, which is evaluated in double precision.
void measureDrift(vec4 c[4], vec4 found, uint at, uint whole, uint steps) {
  atomicMax(mostSteps, steps);
  const double t = double(at) / double(whole), s = double(whole - at) / double(whole);
  const dvec4 exact =
      s * s * s * dvec4(c[0]) + 3.0 * s * s * t * dvec4(c[1]) + 3.0 * s * t * t * dvec4(c[2]) + t * t * t * dvec4(c[3]);
  if (!(exact.w >= double(nearest) && found.w > 0.0)) return;
  const dvec2 off = dvec2(found.xy) / double(found.w) - exact.xy / exact.w;
  atomicMax(mostDrift, floatBitsToUint(length(vec2(off))));
}
#endif

void main() {
  patch_ = patches[gl_WorkGroupID.y];
  const uint curve = gl_WorkGroupID.x * uint(kIsocurveGroup) + gl_LocalInvocationIndex;
  vec4 points[16];
  for (int i = 0; i < 16; ++i) points[i] = clipPoint(i);
  const uint curves = stepsAlong(points, 4, 1);
  if (curve > curves) return;
  const float v = float(curve) / float(curves), s = 1.0 - v;
  vec4 c[4];
  for (int i = 0; i < 4; ++i) {
    precise const vec4 at = s * s * s * points[i] + 3.0 * s * s * v * points[i + 4] + 3.0 * s * v * v * points[i + 8] + v * v * v * points[i + 12];
    c[i] = at;
  }
#ifdef ADAPTIVE
  // Steps are powers of two of the domain: halved where a point moves farther than the spacing, doubled where it moves
  // less than half of it (Lien, Shantz and Pratt 1987).
  const uint whole = uint(kMostIsocurves);
  uint at = 0u, width = whole;
  Walk w = walkFrom(c, 0.0, 1.0);
  plot(w.p, 0.0, v);
  uint since = 0u;
  for (int guard = 0; guard < 4 * kMostIsocurves && at < whole; ++guard) {
    const vec4 next = w.p + w.d1;
    const float moved = w.p.w < nearest || next.w < nearest ? 1e30 : distance(w.p.xy / w.p.w, next.xy / next.w);
    // The middle as well: a loop may end where it began.
    const vec4 halfway = w.p + 0.5 * w.d1 - 0.125 * w.d2 + 0.0625 * w.d3;
    const float there = halfway.w < nearest ? 1e30 : 2.0 * distance(w.p.xy / max(w.p.w, nearest), halfway.xy / halfway.w);
    if (max(moved, there) > spacing && width > 1u) {
      precise const vec4 d3 = 0.125 * w.d3, d2 = 0.25 * w.d2 - d3, d1 = 0.5 * (w.d1 - d2);
      w = Walk(w.p, d1, d2, d3);
      width >>= 1;
      continue;
    }
    step_(w);
    at += width;
    if (++since >= restart) {
      w = walkFrom(c, float(at) / float(whole), float(width) / float(whole));
      since = 0u;
    }
    plot(w.p, float(at) / float(whole), v);
#ifdef COUNTING
    measureDrift(c, w.p, at, whole, whole / width);
#endif
    if (max(moved, there) < 0.5 * spacing && at % (2u * width) == 0u && at + 2u * width <= whole) {
      precise const vec4 d1 = 2.0 * w.d1 + w.d2, d2 = 4.0 * (w.d2 + w.d3), d3 = 8.0 * w.d3;
      w = Walk(w.p, d1, d2, d3);
      width <<= 1;
    }
  }
#else
  const uint steps = stepsAlong(points, 1, 4);
  Walk w;
  for (uint i = 0u; i <= steps; ++i) {
    if (i % restart == 0u) w = walkFrom(c, float(i) / float(steps), 1.0 / float(steps));
    plot(w.p, float(i) / float(steps), v);
#ifdef COUNTING
    measureDrift(c, w.p, i, steps, steps);
#endif
    step_(w);
  }
#endif
}
