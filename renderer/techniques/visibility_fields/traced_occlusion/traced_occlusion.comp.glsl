// SPDX-License-Identifier: BSD-3-Clause
// Mean visibility over a pixel's rays, traced against the objects' triangles.
#include "renderer/techniques/visibility_fields/occlusion_rays.glsl"
#include "renderer/techniques/visibility_fields/object_trace.glsl"
#include "renderer/techniques/visibility_fields/traced_visibility.glsl"

layout(binding = kFieldOutImage, rgba32f) uniform image2D outImage;
uniform int firstRow, lastRow;  // of the rays' cells

void main() {
  makeRayTable();
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  FieldReceiver receiver;
  if (!fieldReceiver(pixel, receiver)) {
    imageStore(outImage, pixel, vec4(1.0));
    return;
  }
  const OcclusionFrame frame = occlusionFrame(pixel, receiver);
  float open = firstRow == 0 ? 0.0 : imageLoad(outImage, pixel).x;
  for (int y = firstRow; y <= lastRow; ++y)
    for (int x = 0; x < raySide; ++x)
      open += tracedVisibility(receiver, occlusionDirection(frame, y * raySide + x));
  if (lastRow == raySide - 1) open /= float(raySide * raySide);
  imageStore(outImage, pixel, rayCutShort ? vec4(uintBitsToFloat(0x7fc00000u)) : vec4(vec3(open), 1.0));
}
