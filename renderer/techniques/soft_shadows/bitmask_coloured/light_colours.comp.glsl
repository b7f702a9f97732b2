// SPDX-License-Identifier: BSD-3-Clause
// Share of the light that reaches a pixel, channel by channel, by its mask. Schwarz 2009, section 4.2.2.
// COLOURS_MASKS: one mask for each colour; COLOURS_TABLE: a table of sums for groups of GROUP_BITS samples; COLOURS_SAMPLES:
// sample by sample.
#include "renderer/techniques/soft_shadows/bitmask_coloured/light_colours_bindings.h"
#include "renderer/techniques/soft_shadows/shadow_bindings.h"
#include "renderer/techniques/soft_shadows/bitmask/occlusion_mask.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kLightColoursReceiversUnit) uniform sampler2D receivers;
layout(binding = kLightColoursColourImage, rgba32f) uniform writeonly image2D outColour;
layout(binding = kKeptMasksImage, rgba32ui) uniform readonly uimage2DArray keptMasks;
#include "renderer/techniques/soft_shadows/bitmask/kept_masks.glsl"
uniform ivec2 sizePx;
uniform int sets;
uniform vec3 absent;  // 1 in channels of which the light has nothing: nothing of it is missing

#if defined(COLOURS_MASKS)
layout(std430, binding = kLightColoursColourMasksBuffer) readonly buffer ColourMasks { uint colourMasks[]; };
layout(std430, binding = kLightColoursSharesBuffer) readonly buffer Shares { vec4 shares[]; };  // of a sample of each colour
uniform int colours;

vec3 visibleColour() {
  vec3 sum = vec3(0.0);
  for (int colour = 0; colour < colours; ++colour) {
    int visible = 0;
    for (int i = 0; i < MASK_WORDS; ++i) visible += bitCount(~mask[i] & colourMasks[colour * MASK_WORDS + i]);
    sum += float(visible) * shares[colour].rgb;
  }
  return sum;
}
#elif defined(COLOURS_TABLE)
layout(std430, binding = kLightColoursTableBuffer) readonly buffer Table { uvec2 table[]; };

vec3 visibleColour() {
  const int kGroups = 32 / GROUP_BITS;  // in a word
  vec3 sum = vec3(0.0);
  for (int i = 0; i < MASK_WORDS; ++i)
    for (int group = 0; group < kGroups; ++group) {
      const uint pattern = bitfieldExtract(~mask[i], group * GROUP_BITS, GROUP_BITS);
      const uvec2 entry = table[((i * kGroups + group) << GROUP_BITS) + int(pattern)];
      sum += vec3(unpackHalf2x16(entry.x), unpackHalf2x16(entry.y).x);
    }
  return sum / float(SAMPLES);
}
#else
layout(std430, binding = kLightColoursSharesBuffer) readonly buffer Shares { vec4 shares[]; };  // of each sample

vec3 visibleColour() {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < MASK_WORDS; ++i)
    for (uint visible = ~mask[i]; visible != 0u; visible &= visible - 1u)
      sum += shares[32 * i + findLSB(visible)].rgb;
  return sum;
}
#endif

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  vec3 colour = vec3(1.0);
  if (texelFetch(receivers, pixel, 0).w >= 0.0) {
    clearMask();
    for (int set = 0; set < sets; ++set) addKeptMask(pixel, set);
    // A light in full view is whole, whatever its parts' rounding adds up to.
    if (samplesCovered() > SAMPLES - LIGHT_SAMPLES) colour = min(visibleColour() + absent, vec3(1.0));
  }
  imageStore(outColour, pixel, vec4(colour, 1.0));
}
