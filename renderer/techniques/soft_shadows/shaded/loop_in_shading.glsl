// SPDX-License-Identifier: BSD-3-Clause
// A pass that shades and evaluates the visibility loop on the way; the including shader includes the loop before.
#include "renderer/techniques/soft_shadows/shaded/shaded_bindings.h"

layout(binding = kShadeIdsUnit) uniform usampler2D triangleIds;
#include "renderer/frame/shading.glsl"
#include "renderer/frame/receiver.glsl"

float sunShare(ivec2 pixel, SeenPoint seen) {
  vec2 plane;
  const vec4 found = receiverAt(seen.position, seen.normal, plane);
  const vec4 receiver = takeReceiver(found, plane);
  return receiver.w < 0.0 ? 0.0 : visibilityOf(receiver, pixel);
}

#ifdef FRAGMENT
layout(location = 0) out vec4 outColour;
#ifdef FORWARD
flat in uint first;
#endif

void main() {
  const ivec2 pixel = ivec2(gl_FragCoord.xy);
  const uint id = texelFetch(triangleIds, pixel, 0).x;
#ifdef FORWARD
  // As a depth test against a pass before would: the triangle is hidden here.
  if (id != first + uint(gl_PrimitiveID)) discard;
#endif
  outColour = vec4(shadedColour(pixel, id), 1.0);
}
#else
layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kShadeImage, rgba32f) uniform writeonly image2D outImage;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  imageStore(outImage, pixel, vec4(shadedColour(pixel, texelFetch(triangleIds, pixel, 0).x), 1.0));
}
#endif
