// SPDX-License-Identifier: BSD-3-Clause
// A ray as the picture shows it: a segment in pixels along which the reversed depth (near over distance along the view)
// changes linearly, as it does along every straight line. See screen_space.cpp.

uniform float near;  // of reversed depths, world units

struct ScreenRay {
  vec2 start, along;        // pixels from the picture's top left corner: start + u along, u from 0 to 1
  float depth, depthAlong;  // likewise
  bool leaves;              // u = 1: it leaves the picture; otherwise it is at infinity there
};

// Place in the picture, times the distance along the view; that distance. `p` in camera space; w = 0: a direction.
vec3 screenPlace(vec4 p) {
  return vec3((0.5 * p.x / rayScale.x - 0.5 * p.z) * float(sizePx.x),
              (-0.5 * p.y / rayScale.y - 0.5 * p.z) * float(sizePx.y), -p.z);
}

// Cut to the part that the picture can show: its four sides and the near plane, before any division.
ScreenRay screenRay(vec3 origin, vec3 direction) {
  const vec3 a = screenPlace(anchorToCamera * vec4(origin, 1.0)), b = screenPlace(anchorToCamera * vec4(direction, 0.0));
  const vec2 size = vec2(sizePx);
  // Each is >= 0 within the picture, and changes linearly along the ray.
  const float from[5] = float[5](a.x, size.x * a.z - a.x, a.y, size.y * a.z - a.y, a.z - near);
  const float change[5] = float[5](b.x, size.x * b.z - b.x, b.y, size.y * b.z - b.y, b.z);
  float last = 1.0e30;
  for (int side = 0; side < 5; ++side)
    if (change[side] < 0.0) last = min(last, max(from[side], 0.0) / -change[side]);
  ScreenRay ray;
  ray.leaves = last < 1.0e30;
  const vec3 end = ray.leaves ? a + last * b : b;
  ray.start = clamp(a.xy / a.z, vec2(0.0), size);
  ray.along = clamp(end.xy / end.z, vec2(0.0), size) - ray.start;
  ray.depth = near / a.z;
  ray.depthAlong = (ray.leaves ? near / end.z : 0.0) - ray.depth;
  return ray;
}
