// SPDX-License-Identifier: BSD-3-Clause
// What the passes of a threshold map share: constants of a run, and where samples of one axis lie on another.
#include "perception/threshold_maps/threshold_map_bindings.h"

layout(std140, binding = kThresholdRunBlock) uniform Run { ThresholdRun run; };

// Where samples lie on another level, as (left, t): at left + t of its axis. For each pair of neighbouring levels
// the finer one's columns and rows on the coarser one, then the coarser one's on the finer one.
layout(std430, binding = kThresholdPlacesBuffer) readonly buffer Places { vec2 places[]; };

// Luminance [cd/m2], finite. Comparisons are false for NaN.
float finiteLuminance(float y) { return y > 0.0 ? min(y, run.light.z) : 0.0; }

float luminanceOf(vec4 texel) {
#if COLOUR
  // Rows of the XYZ matrix of Rec. 709 primaries, so that white has luminance 1; relative light above 1e6 and
  // below 0 is held there, as in DisplayProfile.
  vec3 rgb = vec3(texel.r > 0.0 ? min(texel.r, 1e6) : 0.0, texel.g > 0.0 ? min(texel.g, 1e6) : 0.0,
                  texel.b > 0.0 ? min(texel.b, 1e6) : 0.0);
  float relative = dot(rgb, vec3(0.2126729 / 1.0000001, 0.7151522 / 1.0000001, 0.0721750 / 1.0000001));
  return finiteLuminance(run.light.y * relative + run.light.x);
#else
  return finiteLuminance(texel.r);
#endif
}

int borderIndex(int i, int size) {
#if MIRROR
  int period = 2 * size;
  int folded = i - period * int(floor(float(i) / float(period)));
  return folded < size ? folded : period - 1 - folded;
#else
  return clamp(i, 0, size - 1);
#endif
}

// Sample `x` of an axis of `to` samples lies at left + t of the same axis with `from` samples: (x + 1/2) from /
// to - 1/2, as a fraction, since floats lose its digits on large images.
void place(int x, int from, int to, out int left, out float t) {
  int n = (2 * x + 1) * from - to, d = 2 * to;
  left = int(floor(float(n) / float(d)));
  int rest = n - left * d;
  if (rest < 0) {
    --left;
    rest += d;
  } else if (rest >= d) {
    ++left;
    rest -= d;
  }
  t = float(rest) / float(d);
}
