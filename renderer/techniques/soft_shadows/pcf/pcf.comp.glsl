// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/shadow_lookup.glsl"
#include "renderer/techniques/soft_shadows/percentage_closer.glsl"

uniform float filterRadius;  // texels

float visibilityOf(vec4 receiver, ivec2 pixel) {
  const vec2 size = vec2(2.0 * filterRadius);
  const vec2 centre = mapTexel(receiver.xy / receiver.z);
  const bool inside =
      all(greaterThanEqual(centre + 0.5 * size, vec2(0.0))) && all(lessThan(centre - 0.5 * size, vec2(float(resolution))));
  pixelClass = inside ? kProcessed : kOutside;
  return inside ? percentageCloser(centre, size, receiver, windowDepth(receiver, size)) : shareBeforePlane(receiver);
}
