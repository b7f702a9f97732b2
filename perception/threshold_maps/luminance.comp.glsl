// SPDX-License-Identifier: BSD-3-Clause
// Luminance of the input, for the thesis's own way down the pyramid and for images too small for one.
#include "perception/threshold_maps/threshold_map_bindings.h"
#include "perception/threshold_maps/common.glsl"

layout(local_size_x = kThresholdGroupSide, local_size_y = kThresholdGroupSide) in;
layout(binding = kLuminanceSourceUnit) uniform sampler2D source;
#if HALF
// Luminance less the mean, whose 16 bits hold fainter contrasts.
layout(std430, binding = kThresholdMeanBuffer) readonly buffer Mean { float meanLuminance; };
layout(binding = kLuminanceImage, r16f) uniform writeonly image2D luminance;
#else
layout(binding = kLuminanceImage, r32f) uniform writeonly image2D luminance;
#endif

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(at, imageSize(luminance)))) return;
  float value = luminanceOf(texelFetch(source, at, 0));
#if HALF
  value -= meanLuminance;
#endif
  imageStore(luminance, at, vec4(value));
}
