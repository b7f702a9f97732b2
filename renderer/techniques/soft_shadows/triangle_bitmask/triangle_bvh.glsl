// SPDX-License-Identifier: BSD-3-Clause
// The hierarchy of triangle_bvh.h. Lengths are shares of the scene's reach from the light, light space.
#include "renderer/techniques/soft_shadows/triangle_bitmask/triangle_bitmask_bindings.h"

layout(std430, binding = kTriangleBitmaskNodesBuffer) readonly buffer Nodes { BvhNode nodes[]; };
layout(std430, binding = kTriangleBitmaskTrianglesBuffer) readonly buffer Triangles { BvhTriangle triangles[]; };

// True if a box may meet the pyramid from p to the light, which stands between z = 0 and p.z: on each axis its two sides
// are linear in z. `slack` covers rounding.
bool meetsPyramid(BvhNode node, vec3 p, vec2 halfLight, float slack) {
  const float first = max(node.low.z - slack, 0.0), last = min(node.high.z + slack, p.z);
  if (first > last) return false;
  const vec2 shares = vec2(first, last) / p.z;
  const vec2 centreFirst = p.xy * shares.x, centreLast = p.xy * shares.y;
  const vec2 halfFirst = halfLight * (1.0 - shares.x), halfLast = halfLight * (1.0 - shares.y);
  const vec2 low = min(centreFirst - halfFirst, centreLast - halfLast) - slack,
             high = max(centreFirst + halfFirst, centreLast + halfLast) + slack;
  return all(lessThanEqual(node.low.xy, high)) && all(greaterThanEqual(node.high.xy, low));
}
