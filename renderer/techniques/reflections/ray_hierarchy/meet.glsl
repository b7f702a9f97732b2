// SPDX-License-Identifier: BSD-3-Clause
// A ray against a triangle, and the nearest triangle of each ray. No lock and no 64 bit word: the distance is a minimum,
// and the triangle is replaced by the nearer one, or of two at the same distance by that of the lower number, whose
// distances are found anew. So the order of the pairs changes nothing.
#include "renderer/frame/ray_origin.glsl"
#include "renderer/frame/scene_buffers.glsl"
#include "renderer/ray_tracing/ray_triangle.glsl"
#include "renderer/techniques/reflections/ray_hierarchy/ray_hierarchy_bindings.h"

struct NearestHit {
  uint distance;  // bits of a positive float; 0: its light is in shadow
  uint triangle;
};
layout(binding = kHierarchyOriginsUnit) uniform sampler2D origins;
layout(binding = kHierarchyDirectionsUnit) uniform sampler2D directions;
layout(binding = kHierarchyFromUnit) uniform usampler2D from;

// Distance and barycentric coordinates of the second and third vertex; a distance below 0: none. The same bits wherever
// it is called.
vec3 meeting(vec3 origin, vec3 direction, uint triangle) {
  const uvec3 vertices = sceneTriangle(triangle);
  const RayShear shear = rayShear(direction);
  const vec3 first = scenePosition(vertices.x), second = scenePosition(vertices.y), third = scenePosition(vertices.z);
  const vec3 a = rayPermuted(first - origin, shear.axis), b = rayPermuted(second - origin, shear.axis),
             c = rayPermuted(third - origin, shear.axis);
  const vec2 p = raySheared(a, shear.by), q = raySheared(b, shear.by), r = raySheared(c, shear.by);
  const float u = rayEdge(r, q), v = rayEdge(p, r), w = rayEdge(q, p);
  if (min(u, min(v, w)) < 0.0 && max(u, max(v, w)) > 0.0) return vec3(-1.0);
  precise const float sum = u + v + w;
  if (sum == 0.0) return vec3(-1.0);
  precise const float scaled = u * a.z + v * b.z + w * c.z;
  precise const float t = scaled * shear.by.z / sum;
  if (!(t > 0.0 && t < 3.0e38) || startsInPlane(origin, first, second, third)) return vec3(-1.0);
  return vec3(t, v / sum, w / sum);
}
