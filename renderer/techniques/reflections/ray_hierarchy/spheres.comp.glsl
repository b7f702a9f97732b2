// SPDX-License-Identifier: BSD-3-Clause
// Spheres around triangles, made anew each frame. The smallest one: around the longest edge, or through the corners of an
// acute triangle; its radius is the farthest corner's distance from the centre as rounded.
#include "renderer/frame/scene_buffers.glsl"
#include "renderer/techniques/reflections/ray_hierarchy/ray_hierarchy_bindings.h"

layout(local_size_x = kTraversalGroup) in;
layout(std430, binding = kHierarchySpheresBuffer) writeonly buffer Spheres { vec4 spheres[]; };
uniform uint triangleCount;

void main() {
  const uint triangle = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * uint(kTraversalGroup) +
                        gl_LocalInvocationIndex;
  if (triangle >= triangleCount) return;
  const uvec3 vertices = sceneTriangle(triangle);
  const vec3 a = scenePosition(vertices.x), b = scenePosition(vertices.y), c = scenePosition(vertices.z);
  const vec3 reach = max(abs(b - a), max(abs(c - b), abs(a - c)));
  const float unit = max(reach.x, max(reach.y, reach.z));
  // Without extent, or not finite: no ray meets it.
  if (!(unit > 0.0) || !(unit < 3.0e38)) {
    spheres[triangle] = vec4(0.0, 0.0, 0.0, -1.0);
    return;
  }
  // Scaled: squares of a tiny triangle would leave float's range.
  const vec3 p = (b - a) / unit, q = (c - a) / unit;
  const float pp = dot(p, p), qq = dot(q, q), pq = dot(p, q), rr = pp + qq - 2.0 * pq;
  vec3 centre;
  if (rr >= pp + qq) {
    centre = 0.5 * (p + q);
  } else if (qq >= pp + rr) {
    centre = 0.5 * q;
  } else if (pp >= qq + rr) {
    centre = 0.5 * p;
  } else {
    const float area = pp * qq - pq * pq;
    centre = area > 1e-6 ? 0.5 * (qq * (pp - pq) * p + pp * (qq - pq) * q) / area : 0.5 * (p + q);
  }
  centre = a + unit * centre;
  const float radius = max(length((a - centre) / unit), max(length((b - centre) / unit), length((c - centre) / unit)));
  spheres[triangle] = vec4(centre, radius * unit * 1.000002);
}
