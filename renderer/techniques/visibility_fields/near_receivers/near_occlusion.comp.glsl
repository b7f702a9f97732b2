// SPDX-License-Identifier: BSD-3-Clause
// Mean visibility over the rays of listed pixels, traced: in place of what fields gave them.
#include "renderer/techniques/visibility_fields/occlusion_rays.glsl"
#include "renderer/techniques/visibility_fields/near_receivers/near_trace.glsl"

layout(binding = kFieldOutImage, rgba32f) uniform writeonly image2D outImage;

float seenAt(float distance) { return visibilityAt(distance); }

float openAlong(FieldReceiver receiver, vec3 direction) {
  if (falloff == kFalloffBinary) return nearIsBlocked(receiver, direction, falloffRadius) ? 0.0 : 1.0;
  const float nearest = nearDistance(receiver, direction);
  return nearest < 0.0 ? 1.0 : visibilityAt(nearest);
}

void main() {
  makeRayTable();
  ivec2 pixel;
  FieldReceiver receiver;
  float open = 0.0;
  const bool listed = nearPixel(pixel) && fieldReceiver(pixel, receiver);
  if (listed) {
    const OcclusionFrame frame = occlusionFrame(pixel, receiver);
    for (int i = int(gl_LocalInvocationIndex); i < raySide * raySide; i += kNearGroup) {
      ++rayIterations;
      open += openAlong(receiver, occlusionDirection(frame, i));
    }
  }
  open = nearSum(open) / float(raySide * raySide);
  if (listed && gl_LocalInvocationIndex == 0u) imageStore(outImage, pixel, vec4(vec3(open), 1.0));
}
