// SPDX-License-Identifier: BSD-3-Clause
// Fills what the peeled layers leave. Not a number where pairs found no room: no picture is better than a wrong one.
#include "renderer/techniques/reflections/cone_traced/cone_traced_bindings.h"
#include "renderer/techniques/reflections/cone_traced/fill.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kConeOriginsUnit) uniform sampler2D coneOrigins;
layout(binding = kConeDirectionsUnit) uniform sampler2D coneDirections;
layout(binding = kPeelLayerUnit) uniform sampler2D peeled;
layout(binding = kConeImage, rgba32f) uniform writeonly image2D outImage;
layout(binding = kPeelCounter, offset = 0) uniform atomic_uint itemCount;
uniform ivec2 sizePx;
uniform uint itemRoom;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  vec4 out_ = vec4(0.0);
  if (texelFetch(coneOrigins, pixel, 0).w > 0.0) {
    const vec4 found = texelFetch(peeled, pixel, 0), direction = texelFetch(coneDirections, pixel, 0);
    out_ = filled(found.rgb, found.a, direction.xyz, direction.w);
    if (atomicCounter(itemCount) > itemRoom) out_ = vec4(uintBitsToFloat(0x7fc00000u));
  }
  imageStore(outImage, pixel, out_);
}
