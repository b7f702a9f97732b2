// SPDX-License-Identifier: BSD-3-Clause
// Mean visibility over the rays of listed pixels, traced: in place of what fields gave them.
#include "renderer/techniques/visibility_fields/occlusion_rays.glsl"
#include "renderer/techniques/visibility_fields/near_receivers/near_trace.glsl"
#include "renderer/techniques/visibility_fields/traced_visibility.glsl"

layout(binding = kFieldOutImage, rgba32f) uniform writeonly image2D outImage;

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
      open += tracedVisibility(receiver, occlusionDirection(frame, i));
    }
  }
  open = nearSum(open) / float(raySide * raySide);
  if (listed && gl_LocalInvocationIndex == 0u) imageStore(outImage, pixel, vec4(vec3(open), 1.0));
}
