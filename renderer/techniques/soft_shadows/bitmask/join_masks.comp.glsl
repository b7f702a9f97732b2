// SPDX-License-Identifier: BSD-3-Clause
// Visibility by the masks of several objects together. Schwarz 2009, section 4.2.2.
#include "renderer/techniques/soft_shadows/bitmask/bitmask_bindings.h"
#include "renderer/techniques/soft_shadows/shadow_bindings.h"
#include "renderer/techniques/soft_shadows/bitmask/occlusion_mask.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kJoinMasksReceiversUnit) uniform sampler2D receivers;
layout(binding = kJoinMasksVisibilityImage, r32f) uniform writeonly image2D outVisibility;
layout(binding = kKeptMasksImage, rgba32ui) uniform readonly uimage2DArray keptMasks;
#include "renderer/techniques/soft_shadows/bitmask/kept_masks.glsl"
uniform ivec2 sizePx;
uniform int sets;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  float visibility = 1.0;
  if (texelFetch(receivers, pixel, 0).w >= 0.0) {
    clearMask();
    for (int set = 0; set < sets && !allCovered(); ++set) addKeptMask(pixel, set);
    visibility = visibleShare();
  }
  imageStore(outVisibility, pixel, vec4(visibility));
}
