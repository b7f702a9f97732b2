// SPDX-License-Identifier: BSD-3-Clause
// Luminance of the input [cd/m2], finite.
#include "perception/band_thresholds/band_threshold_bindings.h"

uniform vec3 light;  // black level, white less black, largest luminance [cd/m2]

// Comparisons are false for NaN.
float finiteLuminance(float y) { return y > 0.0 ? min(y, light.z) : 0.0; }

float luminanceOf(vec4 texel) {
#if COLOUR
  // Rows of the XYZ matrix of Rec. 709 primaries, so that white has luminance 1; as in DisplayProfile.
  vec3 rgb = vec3(texel.r > 0.0 ? min(texel.r, 1e6) : 0.0, texel.g > 0.0 ? min(texel.g, 1e6) : 0.0,
                  texel.b > 0.0 ? min(texel.b, 1e6) : 0.0);
  float relative = dot(rgb, vec3(0.2126729 / 1.0000001, 0.7151522 / 1.0000001, 0.0721750 / 1.0000001));
  return finiteLuminance(light.y * relative + light.x);
#else
  return finiteLuminance(texel.r);
#endif
}
