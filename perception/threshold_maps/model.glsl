// SPDX-License-Identifier: BSD-3-Clause
// The psychophysical part: adaptation luminance and contrasts to a threshold. ThresholdModel in GLSL.
#include "perception/threshold_maps/threshold_map_bindings.h"

struct Cell {  // of tables over lg luminance: values at its two ends
  vec2 tvi, peak;
};
layout(std430, binding = kThresholdTablesBuffer) readonly buffer Tables { vec4 tables[]; };
// Elevation over contrast in CSF-normalised units: kSegments an octave from 2^-20, each (value at its start,
// rise over it).
layout(std430, binding = kThresholdElevationsBuffer) readonly buffer Elevations { vec2 elevations[]; };

const float kLgLow = -4.0, kCellsPerDecade = 250.0;

#if !DIRECT
// Octave and place in it are the number's own bits.
float elevationOf(float c) {
  const uint kFirst = (127u - 20u) << 5, kLast = (64u << 5) - 1u;
  uint bits = floatBitsToUint(max(c, 9.5367431640625e-7));
  vec2 segment = elevations[min((bits >> 18) - kFirst, kLast)];
  // The place in the segment, as the mantissa of a number from 1 to 2: quicker than a conversion, and the same.
  return segment.x + segment.y * (uintBitsToFloat(0x3f800000u | (bits & 0x3ffffu) << 5) - 1.0);
}
#elif MASKING == 1  // (1 + x^b)^(1/b), x = factor c^s: masking holds lg2 of factor, s, b
float elevationOf(float c) {
  if (c < 1e-6) return 1.0;
  float lgX = run.masking.x + run.masking.y * log2(c);
#if FOURTH_ROOT
  return lgX > 25.0 ? exp2(lgX) : sqrt(sqrt(1.0 + exp2(4.0 * lgX)));
#else
  float lgPower = run.masking.z * lgX;
  return lgPower > 100.0 ? exp2(lgX) : exp2(log2(1.0 + exp2(lgPower)) / run.masking.z);
#endif
}
#elif MASKING == 2  // Lubin: n, w
float elevationOf(float c) {
  float x = max(c, 1e-6), lg = log2(x);
  return x > 1.0 ? exp2((1.0 - run.masking.y) * lg) * 0.5 * (1.0 + exp2((run.masking.y - run.masking.x) * lg))
                 : exp2((1.0 - run.masking.x) * lg) * 0.5 * (exp2((run.masking.x - run.masking.y) * lg) + 1.0);
}
#elif MASKING == 3  // self: 1 - alpha
float elevationOf(float c) { return c > 0.0 ? exp2(run.masking.x * log2(c)) : 0.0; }
#else
float elevationOf(float c) { return 1.0; }
#endif

#if DIRECT
float wardTvi(float l) {  // l = lg luminance, above -4
  const float kLg2 = 3.3219281;
  float lg = l < -3.94     ? -2.86
             : l < -1.44   ? pow(0.405 * l + 1.6, 2.18) - 2.86
             : l < -0.0184 ? l - 0.395
             : l < 1.9     ? pow(0.249 * l + 0.65, 2.7) - 0.72
                           : l - 1.255;
  return exp2(kLg2 * lg);
}
#endif

// Threshold elevation S of contrasts c and, in .y, the TVI [cd/m2].
vec2 evaluate(float c[BANDS + 1], float luminance) {
  const float kLgOf2 = 0.30102999566;
  float l = clamp(log2(max(luminance, 1e-4)) * kLgOf2, -4.0, 6.0);
  float position = (l - kLgLow) * kCellsPerDecade;
  int last = kThresholdCells - 1;
#if KINK
  float beyond = (luminance - kKinkCdM2) * (1.0 / (kKinkEndCdM2 - kKinkCdM2));
  if (beyond > 0.0 && beyond < 1.0) {
    position = float(kThresholdCells) + float(kThresholdKinkCells) * pow(beyond, kKinkExponent);
    last += kThresholdKinkCells;
  }
#endif
  int cell = min(int(position), last);
  float t = position - float(cell);
  int row = cell * (BANDS + 1);
  vec4 head = tables[row];
#if DIRECT
  float tvi = wardTvi(l);
  float peak = mix(head.z, head.w, t);
  float y = max(luminance, 1e-4);
  float height = 440.0 * pow(1.0 + 0.7 / y, -0.2), decay = -0.3 * 1.44269504 * pow(1.0 + 100.0 / y, 0.15);
#else
  float tvi = mix(head.x, head.y, t);
#endif
  float weighted = 0.0, sum = 0.0;
  for (int i = 0; i < BANDS; ++i) {
#if DIRECT
    float rho = run.bands[i].x;
    float e = exp2(decay * rho);
    float csf = max(height * rho * sqrt(e * (e + 0.06)), 1e-12);
    float f = run.bands[i].z > 0.0 ? run.bands[i].z : max(peak / csf, 1.0);
#else
    vec4 entry = tables[row + 1 + i];
    float csf = mix(entry.x, entry.y, t), f = mix(entry.z, entry.w, t);
#endif
    weighted += c[i] * f * elevationOf(c[i] * csf);
    sum += c[i];
  }
#if FLAT_SMOOTH
  float elevation = max(1.0, (weighted + run.rule.y) / (sum + run.rule.y));
#else
  float elevation = sum > 0.0 ? weighted / sum : 1.0;
#endif
  return vec2(elevation, tvi);
}
