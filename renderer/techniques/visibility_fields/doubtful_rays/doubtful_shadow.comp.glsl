// SPDX-License-Identifier: BSD-3-Clause
// Whether doubtful rays reach their points of the light, traced.
#include "renderer/techniques/visibility_fields/shadow_rays.glsl"
#include "renderer/techniques/visibility_fields/doubtful_rays/doubtful_trace.glsl"

void main() {
  ivec2 pixel;
  int ray;
  FieldReceiver receiver;
  if (!doubtfulRay(pixel, ray) || !fieldReceiver(pixel, receiver)) return;
  const vec3 way = lightPoint(pixel, receiver, ivec2(ray % raySide, ray / raySide)) - receiver.origin;
  const float reach = length(way);
  addTraced(pixel, isBlocked(receiver, way / reach, reach) ? 0.0 : 1.0);
}
