// SPDX-License-Identifier: BSD-3-Clause
// Rays against the triangles of a RayTree: rayAnyHit() and rayClosestHit(). With RAY_GRID: of a TriangleGrid.
//
// Traversal: Ylitie, Karras and Laine 2017 (compressed wide BVH), children in the order of the ray's octant.
// Every box is widened by a bound on the rounding of its distances, so that no ray passes between boxes, runs in the
// plane of one or starts in it unnoticed. Triangles: Woop, Benthin and Wald 2013. Coordinates are sheared once a
// vertex, and the sign of an edge is that of the exact one or zero, which counts as inside: no ray passes between
// triangles that share an edge or a vertex.
//
// RAY_FOREST: of one tree of a RayForest, whose root is rayRoot.
//
// The shader that includes this defines rayHitCounts(), which may reject hits, and sets what RayTree::bind() needs.
#include "renderer/ray_tracing/ray_tracing_bindings.h"
#include "renderer/ray_tracing/ray_triangle.glsl"

#ifdef RAY_GRID
layout(std430, binding = kRayNodesBuffer) readonly buffer RayCells { uint rayCells[]; };  // first entry of each; then triangles
#else
layout(std430, binding = kRayNodesBuffer) readonly buffer RayNodes { uvec4 rayNodes[]; };          // 5 a node
#endif
layout(std430, binding = kRayTrianglesBuffer) readonly buffer RayTriangles { vec4 rayTriangles[]; };  // 3 a triangle

uniform uint rayNodeCount;      // or of cells; 0: nothing to hit
uniform int maxRayIterations;  // of all loops of an invocation that the driver's compiler allows

#ifdef RAY_FOREST
uint rayRoot = 0u;
#else
const uint rayRoot = 0u;
#endif

struct Ray {
  vec3 origin, direction;
  float near, far;  // near < t <= far, in units of the direction
  uint skipped;     // a triangle that is not hit; kRayNoTriangle: none
};
struct RayHit {
  float t;
  uint triangle;  // kRayNoTriangle: none
  float u, v;     // barycentric coordinates of the second and third vertex
};

// False: the ray passes through. a, b, c: the triangle's vertices.
bool rayHitCounts(Ray ray, RayHit hit, vec3 a, vec3 b, vec3 c);

// Loop iterations of this invocation; whoever loops over rays adds his own.
int rayIterations = 0;
// Some ray of this invocation needed more: results are worthless.
bool rayCutShort = false;

const float kRaySlack = 1.9073486e-6;  // 2^-19, share of a distance that its rounding may amount to

// True if the ray hits triangle `index` (of rayTriangles) between near and hit.t, which it then replaces.
bool rayHitsTriangle(Ray ray, RayShear shear, uint index, inout RayHit hit) {
  const vec4 first = rayTriangles[3u * index], second = rayTriangles[3u * index + 1u],
             third = rayTriangles[3u * index + 2u];
  const vec3 a = rayPermuted(first.xyz - ray.origin, shear.axis), b = rayPermuted(second.xyz - ray.origin, shear.axis),
             c = rayPermuted(third.xyz - ray.origin, shear.axis);
  const vec2 p = raySheared(a, shear.by), q = raySheared(b, shear.by), r = raySheared(c, shear.by);
  const float u = rayEdge(r, q), v = rayEdge(p, r), w = rayEdge(q, p);
  if (min(u, min(v, w)) < 0.0 && max(u, max(v, w)) > 0.0) return false;
  const float sum = u + v + w;
  if (sum == 0.0) return false;
  const float t = (u * a.z + v * b.z + w * c.z) * shear.by.z / sum;
  if (!(t > ray.near && t <= hit.t)) return false;
  const uint triangle = floatBitsToUint(first.w);
  if (triangle == ray.skipped) return false;
  const RayHit found = RayHit(t, triangle, v / sum, w / sum);
  if (!rayHitCounts(ray, found, first.xyz, second.xyz, third.xyz)) return false;
  hit = found;
  return true;
}

#ifdef RAY_GRID
#include "renderer/ray_tracing/grid_traverse.glsl"
#else
// 1 + byte / 256, for byte i of a word.
float rayPlane(uint word, int i) {
  const uint bits = i == 0 ? word << 15 : i == 1 ? word << 7 : i == 2 ? word >> 1 : word >> 9;
  return uintBitsToFloat((bits & 0x7f8000u) | 0x3f800000u);
}

// Bits of the hit children among four: inner ones at 24 + their place in the order, leaves' triangles below.
uint rayHitsBoxes(uint metas, uvec3 lows, uvec3 highs, vec3 scale, vec3 offsetLow, vec3 offsetHigh, float near, float far,
                  uint order) {
  uint hits = 0u;
  for (int i = 0; i < 4; ++i) {
    const vec3 entry = vec3(rayPlane(lows.x, i), rayPlane(lows.y, i), rayPlane(lows.z, i)) * scale + offsetLow;
    const vec3 leave = vec3(rayPlane(highs.x, i), rayPlane(highs.y, i), rayPlane(highs.z, i)) * scale + offsetHigh;
    const float from = max(max(entry.x, entry.y), max(entry.z, near));
    const float to = min(min(leave.x, leave.y), min(leave.z, far));
    const uint meta = bitfieldExtract(metas, 8 * i, 8);
    const uint place = (meta & 31u) ^ ((meta & 24u) == 24u ? order : 0u);
    if (!(from > to)) hits |= (meta >> 5) << place;
  }
  return hits;
}

RayHit rayTraverse(Ray ray, bool anyIsEnough) {
  RayHit hit = RayHit(ray.far, kRayNoTriangle, 0.0, 0.0);
  const vec3 size = abs(ray.direction);
  const float largest = max(size.x, max(size.y, size.z));
  if (rayNodeCount == 0u || !(largest > 0.0)) return hit;

  const RayShear shear = rayShear(ray.direction);

  // A direction along an axis is tilted by less than any rounding, so that every quotient is finite.
  const vec3 least = vec3(max(largest * 8.6736174e-19, 7.8886091e-31));
  const bvec3 negative = lessThan(ray.direction, vec3(0.0));
  const vec3 tilted = max(size, least);
  const vec3 inverse = vec3(negative.x ? -1.0 : 1.0, negative.y ? -1.0 : 1.0, negative.z ? -1.0 : 1.0) / tilted;
  // Children are numbered by the octant in which they lie; the nearest are at the top of the order.
  const uint order = (negative.x ? 0u : 4u) | (negative.y ? 0u : 2u) | (negative.z ? 0u : 1u);

  uvec2 stack[kRayStack];
  int depth = 0;
  uvec2 group = uvec2(rayRoot, 0x80000000u);  // first child; those to visit, and which of all are inner
  while (true) {
    rayIterations += 2;  // one for the end of the inner loop
    if (rayIterations > maxRayIterations) {
      rayCutShort = true;
      return hit;
    }
    const int top = findMSB(group.y);
    const uint slot = uint(top - 24) ^ order;
    group.y &= ~(1u << top);
    const uint node = 5u * (group.x + uint(bitCount(group.y & ((1u << slot) - 1u))));
    if (group.y > 0xffffffu) stack[depth++] = group;

    const uvec4 head = rayNodes[node], links = rayNodes[node + 1u], q0 = rayNodes[node + 2u], q1 = rayNodes[node + 3u],
                q2 = rayNodes[node + 4u];
    const vec3 base = (uintBitsToFloat(head.xyz) - ray.origin) * inverse;
    const vec3 scale = 256.0 * uintBitsToFloat((uvec3(head.w, head.w >> 8, head.w >> 16) & 255u) << 23) * inverse;
    const vec3 slack = kRaySlack * (abs(base) + abs(scale));
    const vec3 offsetLow = base - scale - slack, offsetHigh = base - scale + slack;
    uint hits = 0u;
    for (int four = 0; four < 2; ++four) {
      const uvec3 low = four == 0 ? uvec3(q0.x, q0.z, q1.x) : uvec3(q0.y, q0.w, q1.y);
      const uvec3 high = four == 0 ? uvec3(q1.z, q2.x, q2.z) : uvec3(q1.w, q2.y, q2.w);
      const uvec3 entry = uvec3(negative.x ? high.x : low.x, negative.y ? high.y : low.y, negative.z ? high.z : low.z);
      const uvec3 leave = uvec3(negative.x ? low.x : high.x, negative.y ? low.y : high.y, negative.z ? low.z : high.z);
      hits |= rayHitsBoxes(four == 0 ? links.z : links.w, entry, leave, scale, offsetLow, offsetHigh, ray.near, hit.t,
                           order);
    }
    uint triangles = hits & 0xffffffu;
    while (triangles != 0u) {
      if (++rayIterations > maxRayIterations) {
        rayCutShort = true;
        return hit;
      }
      const int next = findLSB(triangles);
      triangles &= triangles - 1u;
      if (rayHitsTriangle(ray, shear, links.y + uint(next), hit) && anyIsEnough) return hit;
    }
    group = uvec2(links.x, (hits & 0xff000000u) | (head.w >> 24));
    if (group.y <= 0xffffffu) {
      if (depth == 0) return hit;
      group = stack[--depth];
    }
  }
  return hit;
}
#endif

// The hit nearest to the origin, its t ray.far and its triangle kRayNoTriangle if there is none.
RayHit rayClosestHit(Ray ray) { return rayTraverse(ray, false); }

// Whether there is a hit at all.
bool rayAnyHit(Ray ray) { return rayTraverse(ray, true).triangle != kRayNoTriangle; }
