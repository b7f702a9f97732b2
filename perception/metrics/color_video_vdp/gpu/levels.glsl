// SPDX-License-Identifier: BSD-3-Clause
// Where the levels of the pyramids lie, and constants of the model.
#include "perception/metrics/color_video_vdp/gpu/cvvdp_bindings.h"

layout(std140, binding = kCvvdpLevelsBlock) uniform Levels {
  ivec4 place[kCvvdpMostBands];   // origin and size of a level in the atlas
  ivec4 groups[kCvvdpMostBands];  // first group and groups across: of the contrast pass, of the mask pass
  vec4 crossMasking[4];           // of a masker on each channel
  vec4 maskerExponent;
  vec4 blurTaps[2];    // 0 to 3, 4 to 6
  vec4 mapWeight[2];   // of channels in the map: masked bands, base band
  vec4 sensitivityGrid;  // log2 of the first background, nodes per octave, unused
  vec4 limits;         // least background, largest contrast, offset of powers, its power of the mask exponent
  vec4 masking;        // mask exponent, mask scale, largest difference, factor of the map's last step
  vec4 maskerOffset;   // offset to the power of each masker exponent
  ivec4 counts;        // bands, groups of the contrast pass, groups of the mask pass, unused
};

int bandOf(int group, int component) {
  int band = counts.x - 2;
  while (band > 0 && groups[band][component] > group) --band;
  return band;
}

// (x + e)^p - e^p; exactly 0 at 0.
float offsetPower(float x, float exponent, float offsetToExponent) {
  return x > 0.0 ? max(pow(x + limits.z, exponent) - offsetToExponent, 0.0) : 0.0;
}
