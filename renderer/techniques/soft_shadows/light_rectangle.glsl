// SPDX-License-Identifier: BSD-3-Clause
// Occluders that are rectangles at one depth, in unit light coordinates.

// Gathers what a rectangle of the light hides: the including shader's.
void accumulate(vec2 low, vec2 high);

#if GAP_FILL == GAP_FILL_LIMITED
uniform float widestGap;  // that is filled, of the light's width
#endif

// Lower bound of a rectangle that begins at `start` and is stretched to `to`, where the neighbour before it ends.
float stretchedTo(float start, float to) {
#if GAP_FILL == GAP_FILL_LIMITED
  return start - to <= widestGap ? min(start, to) : start;
#else
  return min(start, to);
#endif
}

// Gathers the part of an occluder's rectangle that lies on the light.
void accumulateOnLight(vec2 start, vec2 end) {
  ++occluderCount;
  // Clamped in an order that turns a NaN into a bound.
  const vec2 low = min(max(start, vec2(0.0)), vec2(1.0)), high = min(max(end, vec2(0.0)), vec2(1.0));
  if (low.x < high.x && low.y < high.y) {
    ++usedCount;
    accumulate(low, high);
  }
}
