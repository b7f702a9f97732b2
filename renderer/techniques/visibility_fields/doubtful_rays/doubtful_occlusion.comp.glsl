// SPDX-License-Identifier: BSD-3-Clause
// Visibility along doubtful rays, traced.
#include "renderer/techniques/visibility_fields/occlusion_rays.glsl"
#include "renderer/techniques/visibility_fields/doubtful_rays/doubtful_trace.glsl"
#include "renderer/techniques/visibility_fields/traced_visibility.glsl"

void main() {
  ivec2 pixel;
  int ray;
  FieldReceiver receiver;
  if (doubtfulRay(pixel, ray) && fieldReceiver(pixel, receiver))
    addTraced(pixel, tracedVisibility(receiver, occlusionWay(occlusionFrame(pixel, receiver), ray)));
}
