// SPDX-License-Identifier: BSD-3-Clause
// Draws triangles into the tiles of views: an invocation a triangle, a row of groups a view, large ones by the whole group. See
// polygon_tiles.h.
#include "renderer/frame/scene_buffers.glsl"
#include "renderer/many_lods/many_lods_bindings.h"
#include "renderer/techniques/many_lods/many_lods_pass_bindings.h"

layout(local_size_x = kPolygonGroup) in;
layout(std430, binding = kPolygonViewsBuffer) readonly buffer Views { CutView views[]; };
layout(std430, binding = kPolygonDepthsBuffer) buffer Depths { uint depths[]; };

uniform ivec2 tilePx;
uniform uint triangleCount, viewCount;

struct Seen {
  vec3 a, b, c;  // along the view's axes
  ivec2 low, high;
};
shared Seen large[kPolygonGroup];
shared uint largeCount;

vec3 along(CutView view, vec3 position) {
  const vec3 v = position - view.eye.xyz;
  return vec3(dot(v, view.axisX.xyz), dot(v, view.axisY.xyz), dot(v, view.axisZ.xyz));
}

// Pixels whose middles may see the triangle; false: none.
bool boxOf(CutView view, inout Seen seen) {
  seen.low = ivec2(0);
  seen.high = tilePx - 1;
  const float nearest = min(seen.a.z, min(seen.b.z, seen.c.z)), farthest = max(seen.a.z, max(seen.b.z, seen.c.z));
  vec2 low, high;
  if (view.axisZ.w == float(kViewHemisphere)) {
    if (farthest < 0.0) return false;
    // A cone around the three directions, if it is less than a half-space, holds all between them; circles stay circles.
    const float la = length(seen.a), lb = length(seen.b), lc = length(seen.c);
    if (!(min(la, min(lb, lc)) > 0.0)) return true;
    const vec3 a = seen.a / la, b = seen.b / lb, c = seen.c / lc, sum = a + b + c;
    if (!(dot(sum, sum) > 0.25)) return true;
    const vec3 axis = normalize(sum);
    const float cosine = min(dot(axis, a), min(dot(axis, b), dot(axis, c)));
    if (!(cosine > 0.1)) return true;
    // Widened by what rounding of the cosine amounts to.
    const float alpha = acos(min(cosine, 1.0)) + 1e-3, across = length(axis.xy), theta = atan(across, axis.z);
    if (theta + alpha > 2.5) return true;
    const float from = tan(0.5 * (theta - alpha)), to = tan(0.5 * (theta + alpha));
    const vec2 middle = across > 0.0 ? 0.5 * (from + to) * axis.xy / across : vec2(0.0);
    low = middle - 0.5 * (to - from);
    high = middle + 0.5 * (to - from);
  } else {
    if (farthest <= 0.0) return false;
    if (nearest <= 1e-4 * farthest) return true;
    const vec2 tangents = vec2(view.axisX.w, view.axisY.w);
    const vec2 a = seen.a.xy / (seen.a.z * tangents), b = seen.b.xy / (seen.b.z * tangents), c = seen.c.xy / (seen.c.z * tangents);
    low = min(a, min(b, c)) - 1e-5;
    high = max(a, max(b, c)) + 1e-5;
  }
  const vec2 most = vec2(tilePx) + 1.0;
  seen.low = max(ivec2(ceil(clamp((0.5 + 0.5 * low) * vec2(tilePx) - 0.5, vec2(-1.0), most))), ivec2(0));
  seen.high = min(ivec2(floor(clamp((0.5 + 0.5 * high) * vec2(tilePx) - 0.5, vec2(-2.0), most))), tilePx - 1);
  return all(lessThanEqual(seen.low, seen.high));
}

void cover(CutView view, uint number, Seen seen, ivec2 pixel) {
  const vec2 at = 2.0 * (vec2(pixel) + 0.5) / vec2(tilePx) - 1.0;
  const float square = dot(at, at);
  const vec3 direction = view.axisZ.w == float(kViewHemisphere) ? vec3(2.0 * at, 1.0 - square) / (1.0 + square)
                                                                : vec3(at * vec2(view.axisX.w, view.axisY.w), 1.0);
  const float u = dot(cross(seen.a, seen.b), direction), v = dot(cross(seen.b, seen.c), direction),
              w = dot(cross(seen.c, seen.a), direction);
  if (min(u, min(v, w)) < 0.0 && max(u, max(v, w)) > 0.0) return;
  const vec3 normal = cross(seen.b - seen.a, seen.c - seen.a);
  const float distance_ = dot(normal, seen.a) / dot(normal, direction);
  if (!(distance_ > 0.0)) return;
  const uint at_ = (number * uint(tilePx.y) + uint(pixel.y)) * uint(tilePx.x) + uint(pixel.x);
  atomicMin(depths[at_], floatBitsToUint(min(distance_ * view.frustum.z, kFarthestDepth)));
}

void main() {
  const uint me = gl_LocalInvocationIndex;
  for (uint number = gl_WorkGroupID.y; number < viewCount; number += gl_NumWorkGroups.y) {
    const CutView view = views[number];
    for (uint first = gl_WorkGroupID.x * uint(kPolygonGroup); first < triangleCount; first += gl_NumWorkGroups.x * uint(kPolygonGroup)) {
      if (me == 0u) largeCount = 0u;
      barrier();
      if (first + me < triangleCount) {
        const uvec3 corners = sceneTriangle(first + me);
        Seen seen;
        seen.a = along(view, scenePosition(corners.x));
        seen.b = along(view, scenePosition(corners.y));
        seen.c = along(view, scenePosition(corners.z));
        if (boxOf(view, seen)) {
          const ivec2 size = seen.high - seen.low + 1;
          if (size.x * size.y > kSmallPolygonPx) {
            large[atomicAdd(largeCount, 1u)] = seen;
          } else {
            for (int y = seen.low.y; y <= seen.high.y; ++y)
              for (int x = seen.low.x; x <= seen.high.x; ++x) cover(view, number, seen, ivec2(x, y));
          }
        }
      }
      barrier();
      const uint count = largeCount;
      for (uint i = 0u; i < count; ++i) {
        const Seen shared_ = large[i];
        const ivec2 size = shared_.high - shared_.low + 1;
        for (int pixel = int(me); pixel < size.x * size.y; pixel += kPolygonGroup)
          cover(view, number, shared_, shared_.low + ivec2(pixel % size.x, pixel / size.x));
      }
      barrier();
    }
  }
}
