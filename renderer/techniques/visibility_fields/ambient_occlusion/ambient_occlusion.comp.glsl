// SPDX-License-Identifier: BSD-3-Clause
// Mean visibility over a pixel's rays, their distances looked up in the objects' fields.
#include "renderer/techniques/visibility_fields/occlusion_rays.glsl"
#include "renderer/techniques/visibility_fields/object_lookup.glsl"

layout(binding = kFieldOutImage, rgba32f) uniform writeonly image2D outImage;

#if COMBINE == 0
float openShare(FieldReceiver receiver, OcclusionFrame frame) {
  float open = 0.0;
  for (int y = 0; y < raySide; ++y)
    for (int x = 0; x < raySide; ++x) {
      const float nearest = nearestDistance(receiver, occlusionDirection(frame, ivec2(x, y)));
      open += nearest < 0.0 ? 1.0 : visibilityAt(nearest);
    }
  return open / float(raySide * raySide);
}
#else
float openShareOf(FieldReceiver receiver, OcclusionFrame frame, uint object) {
  float open = 0.0;
  for (int y = 0; y < raySide; ++y)
    for (int x = 0; x < raySide; ++x) {
      const float distance = fieldDistance(object, receiver.origin, occlusionDirection(frame, ivec2(x, y)), slack);
      open += distance < 0.0 ? 1.0 : visibilityAt(distance);
    }
  return open / float(raySide * raySide);
}

float openShare(FieldReceiver receiver, OcclusionFrame frame) {
  float open = 1.0;
  for (uint object = 0u; object < fieldObjectCount; ++object) {
    if (!canBlock(receiver, object)) continue;
#if COMBINE == 1
    open *= openShareOf(receiver, frame, object);
#else
    open -= 1.0 - openShareOf(receiver, frame, object);
#endif
  }
  return max(open, 0.0);
}
#endif

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  FieldReceiver receiver;
  float open = 1.0;
  if (fieldReceiver(pixel, receiver)) open = openShare(receiver, occlusionFrame(pixel, receiver));
  imageStore(outImage, pixel, vec4(vec3(open), 1.0));
  countLookUps(pixel);
}
