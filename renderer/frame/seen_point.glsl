// SPDX-License-Identifier: BSD-3-Clause
// Where the ray through a pixel's centre meets the triangle that the pixel sees, in camera space.

struct SeenPoint {
  vec3 position, normal;  // normal: of the triangle's plane, unit, turned to the camera
  float depth;            // distance along the view
};

// Through a place of the image, in pixels from its top left corner. `rayScale`: half the image's extents at distance 1.
vec3 placeRay(vec2 place, vec2 rayScale, ivec2 sizePx) {
  const vec2 ndc = vec2(2.0, -2.0) * place / vec2(sizePx) + vec2(-1.0, 1.0);
  return vec3(ndc * rayScale, -1.0);
}

vec3 pixelRay(ivec2 pixel, vec2 rayScale, ivec2 sizePx) { return placeRay(vec2(pixel) + 0.5, rayScale, sizePx); }

// Unit normal of a triangle's plane, either side; not finite for a triangle without area.
vec3 planeNormal(vec3 a, vec3 b, vec3 c) {
  // Scaled before the product: squares of a tiny scene's areas would leave float's range.
  const vec3 e1 = b - a, e2 = c - a;
  const vec3 reach = max(abs(e1), abs(e2));
  const float unit = 1.0 / max(reach.x, max(reach.y, reach.z));
  return normalize(cross(e1 * unit, e2 * unit));
}

// Distance along the view at which a ray (with z = -1) meets the triangle with this normal.
float depthSeen(vec3 a, vec3 b, vec3 c, vec3 normal, vec3 ray) {
  // Edge-on triangles make the quotient meaningless; the surface cannot lie outside the triangle's own depths.
  const float nearest = min(-a.z, min(-b.z, -c.z)), farthest = max(-a.z, max(-b.z, -c.z));
  const float denominator = dot(normal, ray);
  const float depth = dot(normal, a) / denominator;
  return depth > nearest ? min(depth, farthest) : nearest;  // also turns a NaN into `nearest`
}

SeenPoint pointSeen(vec3 a, vec3 b, vec3 c, vec3 ray) {
  SeenPoint seen;
  seen.normal = planeNormal(a, b, c);
  seen.depth = depthSeen(a, b, c, seen.normal, ray);
  seen.position = ray * seen.depth;
  if (dot(seen.normal, seen.position) > 0.0) seen.normal = -seen.normal;
  return seen;
}

// Barycentric coordinates of a point on the triangle, within it; the first corner's for a triangle without area.
vec3 barycentrics(vec3 a, vec3 b, vec3 c, vec3 point) {
  const vec3 e1 = b - a, e2 = c - a;
  const vec3 reach = max(abs(e1), abs(e2));
  const float unit = 1.0 / max(reach.x, max(reach.y, reach.z));
  const vec3 u = e1 * unit, v = e2 * unit, p = (point - a) * unit, n = cross(u, v);
  const float area = dot(n, n);
  vec2 yz = vec2(dot(cross(p, v), n), dot(cross(u, p), n)) / area;
  // Written so that a NaN becomes 0.
  yz = vec2(yz.x > 0.0 ? min(yz.x, 1.0) : 0.0, yz.y > 0.0 ? min(yz.y, 1.0) : 0.0);
  const float sum = yz.x + yz.y;
  if (sum > 1.0) yz /= sum;
  return vec3(1.0 - yz.x - yz.y, yz);
}
