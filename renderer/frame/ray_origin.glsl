// SPDX-License-Identifier: BSD-3-Clause
// Where rays that leave a surface start, and what they cannot meet there. See mirror_rays.h. Set up by
// configureRayOrigins().
#include "renderer/frame/seen_point.glsl"

uniform float originTolerance;  // world units

// The point of a triangle that `position`, known up to rounding, stands for: a weighted mean of the corners, so that it lies
// within originTolerance of the triangle however far the camera is.
vec3 pointOnTriangle(vec3 a, vec3 b, vec3 c, vec3 position) {
  const vec3 weights = barycentrics(a, b, c, position);
  return weights.x * a + weights.y * b + weights.z * c;
}

// True if the plane of a triangle (a, b, c) contains a ray's origin up to rounding: from there it is edge-on, and no ray meets
// it. So is a triangle without area.
bool startsInPlane(vec3 origin, vec3 a, vec3 b, vec3 c) {
  const vec3 e1 = b - a, e2 = c - a, reach = max(abs(e1), abs(e2));
  const float unit = 1.0 / max(reach.x, max(reach.y, reach.z));
  const vec3 n = cross(e1 * unit, e2 * unit);
  return !(abs(dot(n, a - origin)) > originTolerance * length(n));
}
