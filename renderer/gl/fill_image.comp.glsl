// SPDX-License-Identifier: BSD-3-Clause
// All texels of a level of an image become the same; IMAGE says of what kind it is.
#include "renderer/gl/fill_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kFilledImage) uniform writeonly IMAGE image;
#ifdef UNSIGNED
uniform uint valueX, valueY, valueZ, valueW;
#else
uniform vec4 value;
#endif

void main() {
#ifdef LAYERS
  const ivec3 texel = ivec3(gl_GlobalInvocationID);
#else
  const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
#endif
  if (any(greaterThanEqual(texel, imageSize(image)))) return;
#ifdef UNSIGNED
  imageStore(image, texel, uvec4(valueX, valueY, valueZ, valueW));
#else
  imageStore(image, texel, value);
#endif
}
