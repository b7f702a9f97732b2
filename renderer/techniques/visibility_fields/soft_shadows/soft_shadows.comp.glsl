// SPDX-License-Identifier: BSD-3-Clause
// Share of a light's points that no object hides by its field: none lies nearer than the point.
#include "renderer/techniques/visibility_fields/shadow_rays.glsl"
#include "renderer/techniques/visibility_fields/object_lookup.glsl"
#include "renderer/techniques/visibility_fields/near_receivers/near_list.glsl"
#include "renderer/techniques/visibility_fields/doubtful_rays/doubtful_list.glsl"

layout(binding = kFieldOutImage, r32f) uniform writeonly image2D outImage;

float reach = 0.0;  // of the ray that is looked up
float seenAt(float distance) { return distance < reach ? 0.0 : 1.0; }

float seenShare(ivec2 pixel, FieldReceiver receiver) {
  float seen = 0.0;
  for (int y = 0; y < raySide; ++y)
    for (int x = 0; x < raySide; ++x) {
      const vec3 way = lightPoint(pixel, receiver, ivec2(x, y)) - receiver.origin;
      reach = length(way);
      seen += countedRay(y * raySide + x, seenPastAll(receiver, way / reach));
    }
  return seen / float(raySide * raySide);
}

void main() {
  beginRays();
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (all(lessThan(pixel, sizePx))) {
    FieldReceiver receiver;
    float seen = 1.0;
    if (isLit(pixel) && fieldReceiver(pixel, receiver)) seen = seenShare(pixel, receiver);
    imageStore(outImage, pixel, vec4(seen));
    listIfNear(pixel);
    countLookUps(pixel);
  }
  endRays(pixel);
}
