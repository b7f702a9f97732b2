// SPDX-License-Identifier: BSD-3-Clause
// Where a pixel's ray meets the PN triangle within a prism, by Newton's method from several starts. See pn_prisms.cpp.
#include "renderer/frame/seen_point.glsl"
#include "renderer/techniques/ray_casting/ray_casting_bindings.h"
#include "renderer/techniques/tessellation/tessellation_bindings.h"

flat in uint patch_;
in vec2 startBelow;
layout(location = 0) out uint id;
layout(location = 1) out vec4 normalAndDistance;

layout(std430, binding = kCurvedTrianglesBuffer) readonly buffer CurvedTriangles { CurvedTriangle triangles[]; };

uniform ivec2 sizePx;
uniform vec2 rayScale;
uniform mat4 cameraToAnchor;
uniform float tolerance;     // at distance 1 along the view
uniform float nearest;       // distance of the near plane, along the view
uniform float cornerOffset;  // of the starts near corners and sides
uniform int steps;

#ifdef COUNTING
layout(binding = kNewtonStepsImage, r32ui) uniform uimage2D newtonSteps;
layout(binding = kStartsTriedImage, r32ui) uniform uimage2D startsTried;
layout(binding = kPrismFragmentsImage, r32ui) uniform uimage2D prismFragments;
#endif

float firstPlace = 0.0;  // where the ray passes the near plane

// The triangle in the ray's coordinates: x and y are distances from two perpendicular planes through the ray, z is
// measured along it.
vec3 points[10];

struct Point {
  vec3 p, alongU, alongV;
};

// By de Casteljau's algorithm.
Point pointAt(vec2 at) {
  const float u = at.x, v = at.y, w = 1.0 - u - v;
  const vec3 c200 = u * points[0] + v * points[1] + w * points[2], c110 = u * points[1] + v * points[3] + w * points[4],
             c101 = u * points[2] + v * points[4] + w * points[5], c020 = u * points[3] + v * points[6] + w * points[7],
             c011 = u * points[4] + v * points[7] + w * points[8], c002 = u * points[5] + v * points[8] + w * points[9];
  const vec3 e100 = u * c200 + v * c110 + w * c101, e010 = u * c110 + v * c020 + w * c011,
             e001 = u * c101 + v * c011 + w * c002;
  return Point(u * e100 + v * e010 + w * e001, 3.0 * (e100 - e001), 3.0 * (e010 - e001));
}

uint stepCount = 0u, startCount = 0u;

// How far the domain is from `at`, measured across the ray by the tangents at a root, so that a triangle's size and slant
// do not matter. Moves `at` into the domain.
float distanceOutside(inout vec2 at, Point found) {
  vec2 inside = max(at, vec2(0.0));
  const float over = inside.x + inside.y - 1.0;
  if (over > 0.0) {
    inside -= 0.5 * over;
    inside = inside.x < 0.0 ? vec2(0.0, 1.0) : inside.y < 0.0 ? vec2(1.0, 0.0) : inside;
  }
  const vec2 move = inside - at;
  at = inside;
  return length(move.x * found.alongU.xy + move.y * found.alongV.xy);
}

// From `at`, to a root in the domain beyond the near plane. Of two triangles with a common side, one has a root of that
// side in its domain, and Newton's method ends within `allowed` of it: so far outside a root must count, or holes remain.
bool newton(inout vec2 at, float allowed, out Point found) {
  ++startCount;
  for (int i = 0; i <= steps; ++i) {
    found = pointAt(at);
    if (dot(found.p.xy, found.p.xy) <= allowed * allowed)
      return found.p.z >= firstPlace && distanceOutside(at, found) <= allowed;
    if (i == steps) break;
    ++stepCount;
    const float det = found.alongU.x * found.alongV.y - found.alongV.x * found.alongU.y;
    at -= vec2(found.p.x * found.alongV.y - found.alongV.x * found.p.y, found.alongU.x * found.p.y - found.p.x * found.alongU.y) / det;
    // Far outside, or not a number: this start leads nowhere.
    if (!(max(abs(at.x), abs(at.y)) < 4.0)) return false;
  }
  return false;
}

// The hull of the control points lies to one side of the ray: there is no root, and no start need be tried.
bool hullMisses(float allowed) {
  vec4 low = vec4(1e30), high = vec4(-1e30);
  for (int i = 0; i < 10; ++i) {
    const vec4 across = vec4(points[i].xy, points[i].x + points[i].y, points[i].x - points[i].y);
    low = min(low, across);
    high = max(high, across);
  }
  return any(greaterThan(low, vec4(allowed))) || any(lessThan(high, vec4(-allowed)));
}

#if STARTS > 1
// Middle, near the corners, near the middles of the sides, then between those: weights of the corners.
vec2 startOf(int number) {
  const float near = cornerOffset;
  if (number == 0) return vec2(1.0 / 3.0);
  if (number < 4) return vec2(number == 1 ? 1.0 - 2.0 * near : near, number == 2 ? 1.0 - 2.0 * near : near);
  if (number < 7) return vec2(number == 4 ? near : 0.5 * (1.0 - near), number == 5 ? near : 0.5 * (1.0 - near));
  const float rest = 1.0 - near, many = 0.7 * rest, few = 0.3 * rest;
  const vec3 order = number == 7    ? vec3(many, few, near)
                     : number == 8  ? vec3(few, many, near)
                     : number == 9  ? vec3(many, near, few)
                     : number == 10 ? vec3(few, near, many)
                     : number == 11 ? vec3(near, many, few)
                                    : vec3(near, few, many);
  return order.xy;
}

// Distance along the ray at which a start lies; of those near corners the corner's, which needs no evaluation.
float placeOf(int number) {
  if (number >= 1 && number < 4) return points[number == 1 ? 0 : number == 2 ? 6 : 9].z;
  return pointAt(startOf(number)).p.z;
}
#endif

bool firstHit(float allowed, out vec2 at, out Point found) {
#if STARTS == 1
  at = clamp(startBelow, vec2(0.0), vec2(1.0));
  const float outside = at.x + at.y - 1.0;
  if (outside > 0.0) at = max(at - 0.5 * outside, vec2(0.0));
  return newton(at, allowed, found);
#else
  int order[STARTS];
  float places[STARTS];
  for (int i = 0; i < STARTS; ++i) {
    const float place = placeOf(i);
    int slot = i;
#ifdef SORTED
    for (; slot > 0 && places[slot - 1] > place; --slot) places[slot] = places[slot - 1], order[slot] = order[slot - 1];
#endif
    places[slot] = place, order[slot] = i;
  }
  for (int i = 0; i < STARTS; ++i) {
    at = startOf(order[i]);
    if (newton(at, allowed, found)) return true;
  }
  return false;
#endif
}

vec3 fieldNormal(uint number, vec2 at) {
  const float u = at.x, v = at.y, w = 1.0 - u - v;
  const vec4 n[6] = triangles[number].normals;
  return (u * u * n[0] + v * v * n[3] + w * w * n[5] + 2.0 * (u * v * n[1] + u * w * n[2] + v * w * n[4])).xyz;
}

void main() {
  const vec3 inCamera = placeRay(gl_FragCoord.xy, rayScale, sizePx);
  const float lengthPerDistance = length(inCamera);
  const vec3 ray = mat3(cameraToAnchor) * (inCamera / lengthPerDistance), eye = cameraToAnchor[3].xyz;
  const vec3 a = abs(ray);
  const vec3 axis = a.x <= a.y && a.x <= a.z ? vec3(1.0, 0.0, 0.0) : a.y <= a.z ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0);
  const vec3 n1 = normalize(cross(ray, axis)), n2 = cross(ray, n1);
  const mat3 fromRay = mat3(n1, n2, ray);
  for (int i = 0; i < 10; ++i) points[i] = (triangles[patch_].points[i].xyz - eye) * fromRay;
  firstPlace = nearest * lengthPerDistance;
  vec2 at;
  Point found;
  const float allowed = tolerance / gl_FragCoord.w;
  const bool hit = !hullMisses(allowed) && firstHit(allowed, at, found);
#ifdef COUNTING
  const ivec2 pixel = ivec2(gl_FragCoord.xy);
  imageAtomicAdd(newtonSteps, pixel, stepCount);
  imageAtomicAdd(startsTried, pixel, startCount);
  imageAtomicAdd(prismFragments, pixel, 1u);
#endif
  if (!hit) discard;
  const float distance_ = found.p.z / lengthPerDistance;
  // Which side is seen decides the surface; the field may differ from it.
  const vec3 geometric = fromRay * cross(found.alongU, found.alongV);
  vec3 normal = triangles[patch_].hasNormals != 0u ? fieldNormal(patch_, at) : geometric;
  if (dot(geometric, ray) > 0.0) normal = -normal;
  id = kSurfaceOfPatch | triangles[patch_].material;
  normalAndDistance = vec4(normal, distance_);
  gl_FragDepth = nearest / distance_;
}
