// SPDX-License-Identifier: BSD-3-Clause
// Share of a light's points that listed pixels see, traced: in place of what fields gave them.
#include "renderer/techniques/visibility_fields/shadow_rays.glsl"
#include "renderer/techniques/visibility_fields/near_receivers/near_trace.glsl"

layout(binding = kFieldOutImage, r32f) uniform writeonly image2D outImage;

void main() {
  ivec2 pixel;
  FieldReceiver receiver;
  float seen = 0.0;
  const bool listed = nearPixel(pixel) && fieldReceiver(pixel, receiver);
  if (listed)
    for (int i = int(gl_LocalInvocationIndex); i < raySide * raySide; i += kNearGroup) {
      ++rayIterations;
      const vec3 way = lightPoint(pixel, receiver, ivec2(i % raySide, i / raySide)) - receiver.origin;
      const float reach = length(way);
      seen += isBlocked(receiver, way / reach, reach) ? 0.0 : 1.0;
    }
  seen = nearSum(seen) / float(raySide * raySide);
  if (listed && gl_LocalInvocationIndex == 0u) imageStore(outImage, pixel, vec4(seen));
}
