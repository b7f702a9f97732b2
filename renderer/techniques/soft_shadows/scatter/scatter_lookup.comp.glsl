// SPDX-License-Identifier: BSD-3-Clause
// Projects the soft shadow map onto the receivers that the camera sees.
#include "renderer/techniques/soft_shadows/scatter/scatter_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kScatterLookupSeenPointsUnit) uniform sampler2D seenPoints;
layout(binding = kScatterLookupReceiversUnit) uniform sampler2D receivers;
layout(binding = kScatterLookupIdsUnit) uniform usampler2D triangleIds;
layout(binding = kScatterLookupHiddenUnit) uniform usampler2D hidden;
layout(binding = kScatterLookupHiddenBySecondUnit) uniform usampler2D hiddenBySecond;
layout(binding = kScatterLookupVisibilityImage, r32f) uniform writeonly image2D outVisibility;
#ifdef COUNT
layout(binding = kScatterLookupClassesImage, r32ui) uniform writeonly uimage2D outClasses;
#endif
layout(std430, binding = kScatterCostsBuffer) readonly buffer Costs { ScatterCosts costs; };
layout(std430, binding = kScatterLookupReceiverBitsBuffer) readonly buffer ReceiverBits { uint receiverBits[]; };  // a bit for each triangle

uniform ivec2 sizePx;
uniform int softResolution;
uniform vec2 softLow, softSize;
uniform uint triangleCount;

#include "renderer/techniques/soft_shadows/pixel_class.h"

float visibilityAt(ivec2 texel) {
  uint most = texelFetch(hidden, texel, 0).x;
#ifdef SECOND
  most = max(most, texelFetch(hiddenBySecond, texel, 0).x);
#endif
  return 1.0 - min(float(most) / WHOLE, 1.0);
}

// Between the four texels around it that show a receiver; negative if none does.
float interpolated(vec2 at) {
  const vec2 corner = floor(at - 0.5), share = at - 0.5 - corner;
  float sum = 0.0, weights = 0.0;
  for (int i = 0; i < 4; ++i) {
    const ivec2 step = ivec2(i & 1, i >> 1);
    const ivec2 texel = clamp(ivec2(corner) + step, ivec2(0), ivec2(softResolution - 1));
    if (texelFetch(receivers, texel, 0).x <= 0.0) continue;
    const vec2 part = mix(1.0 - share, share, vec2(step));
    sum += part.x * part.y * visibilityAt(texel);
    weights += part.x * part.y;
  }
  // A mean of shares is one, however its parts are rounded; pixels in full light are told by it.
  return weights > 0.0 ? clamp(sum / weights, 0.0, 1.0) : -1.0;
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const vec4 p = texelFetch(seenPoints, pixel, 0);
  float visibility = 1.0;
  uint pixelClass = kNotReceiver;
  if (p.w >= 0.0) {
    // Casters receive no shadow: a limit of the method.
    pixelClass = kOutside;
    const uint id = texelFetch(triangleIds, pixel, 0).x;
    const vec2 at = (p.xy / p.z - softLow) / softSize * float(softResolution);
    const bool inside = all(greaterThanEqual(at, vec2(0.0))) && all(lessThanEqual(at, vec2(float(softResolution))));
    if (id < triangleCount && (receiverBits[id >> 5] >> (id & 31u) & 1u) != 0u && inside) {
      const float found = interpolated(at);
      if (found >= 0.0) {
        visibility = found;
        pixelClass = found == 1.0 ? kLit : found == 0.0 ? kUmbra : kProcessed;
      }
    }
    if (costs.cutShort > 0u) {
      pixelClass = kCutShort;
      visibility = uintBitsToFloat(0x7fc00000u);  // no number rather than a wrong one
    }
  }
  imageStore(outVisibility, pixel, vec4(visibility));
#ifdef COUNT
  imageStore(outClasses, pixel, uvec4(pixelClass));
#endif
}
