// SPDX-License-Identifier: BSD-3-Clause
// Samples of the light behind the receiver's own plane, which shadow maps say nothing of. Needs shadow_lookup.glsl and
// occlusion_mask.glsl, mask_rows.glsl.
#ifdef BIAS_PLANE
#if SAMPLE_PLACES == SAMPLE_PLACES_ANYWHERE
// As the strips of a table of rectangles that lie behind the plane at their middles.
void hideSamplesBehind(vec2 perUnit, float limit) {
  const float steps = float(RECTANGLES);
  for (int i = 0; i < RECTANGLES; ++i) {
    const float x = (float(i) + 0.5) / steps, rest = limit - perUnit.x * x;
    const float bound = clamp(perUnit.y == 0.0 ? (rest <= 0.0 ? 0.0 : 1.0) : rest / perUnit.y, 0.0, 1.0);
    const vec2 hidden = perUnit.y < 0.0 ? vec2(0.0, bound) : vec2(bound, 1.0);
    if (hidden.x < hidden.y) addToMask(vec2(float(i) / steps, hidden.x), vec2(float(i + 1) / steps, hidden.y));
  }
}
#else
// Samples (i + offset.x) / n of the row at y that lie behind the plane.
uint rowBehind(vec2 perUnit, float limit, float y, float offsetX) {
  const float rest = limit - perUnit.y * y;
  if (perUnit.x == 0.0) return rest <= 0.0 ? bitRange(0, kSamplesAlong) : 0u;
  const float at = clamp(rest / perUnit.x * float(kSamplesAlong) - offsetX, -1.0, float(kSamplesAlong));
  return perUnit.x > 0.0 ? bitRange(max(int(ceil(at)), 0), kSamplesAlong) : bitRange(0, int(floor(at)) + 1);
}

void hideSamplesBehind(vec2 perUnit, float limit) {
  for (int j = 0; j < kSamplesAlong; ++j) {
#if SAMPLE_PLACES == SAMPLE_PLACES_JITTERED_GRID
    const float offsetX = (j & 1) == 0 ? 0.25 : 0.75;
    const uint even = rowBehind(perUnit, limit, (float(j) + 0.75) / 16.0, offsetX),
               odd = rowBehind(perUnit, limit, (float(j) + 0.25) / 16.0, offsetX);
    addRow(j, joinedColumns(even, odd));
#else
    addRow(j, rowBehind(perUnit, limit, (float(j) + 0.5) / float(kSamplesAlong), 0.5));
#endif
  }
}
#endif
// A point (s - eye) lightSize of the light is behind the plane if g . point >= p_z; before it, if the eye is behind.
void hideBehindPlane(vec4 p) {
  if (!planeCutsLight(p)) return;
  const float side = eyeIsBehind ? -1.0 : 1.0;
  const vec2 perUnit = side * receiverPlane * lightSize;
  hideSamplesBehind(perUnit, side * p.z + dot(perUnit, eyeOnLight));
}
#else
void hideBehindPlane(vec4 p) {}
#endif
