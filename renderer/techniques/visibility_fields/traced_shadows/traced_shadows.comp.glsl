// SPDX-License-Identifier: BSD-3-Clause
// Share of a light's points that no triangle of an object hides.
#include "renderer/techniques/visibility_fields/shadow_rays.glsl"
#include "renderer/techniques/visibility_fields/object_trace.glsl"

layout(binding = kFieldOutImage, r32f) uniform image2D outImage;
uniform int firstRow, lastRow;  // of the rays' cells

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  FieldReceiver receiver;
  if (!(isLit(pixel) && fieldReceiver(pixel, receiver))) {
    imageStore(outImage, pixel, vec4(1.0));
    return;
  }
  float seen = firstRow == 0 ? 0.0 : imageLoad(outImage, pixel).x;
  for (int y = firstRow; y <= lastRow; ++y)
    for (int x = 0; x < raySide; ++x) {
      const vec3 way = lightPoint(pixel, receiver, ivec2(x, y)) - receiver.origin;
      const float reach = length(way);
      seen += isBlocked(receiver, way / reach, reach) ? 0.0 : 1.0;
    }
  if (lastRow == raySide - 1) seen /= float(raySide * raySide);
  imageStore(outImage, pixel, vec4(rayCutShort ? uintBitsToFloat(0x7fc00000u) : seen));
}
