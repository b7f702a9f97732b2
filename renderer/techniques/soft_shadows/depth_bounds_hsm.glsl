// SPDX-License-Identifier: BSD-3-Clause
// Depth range of an area by the hierarchical shadow map (HSM): min/max over aligned squares. Schwarz 2009, section 4.1.
// Smallest and largest depth over an area: the finest level at which at most 2 x 2 texels cover it.
vec2 tileRange(Area area) {
  const ivec2 last = area.high - 1;
  const int extent = max(last.x - area.low.x, last.y - area.low.y);
  int level = extent > 0 ? findMSB(extent) : 0;
  if (any(greaterThan((last >> level) - (area.low >> level), ivec2(1)))) ++level;
  const ivec2 a = area.low >> level, b = last >> level;
  boundFetches += 8u;
  const float low = min(min(minimumDepth(a, level), minimumDepth(ivec2(b.x, a.y), level)),
                        min(minimumDepth(ivec2(a.x, b.y), level), minimumDepth(b, level)));
  float high;
  if (level == 0) {
    high = max(max(minimumDepth(a, 0), minimumDepth(ivec2(b.x, a.y), 0)),
               max(minimumDepth(ivec2(a.x, b.y), 0), minimumDepth(b, 0)));
  } else {
    high = max(max(maximumDepth(a, level - 1), maximumDepth(ivec2(b.x, a.y), level - 1)),
               max(maximumDepth(ivec2(a.x, b.y), level - 1), maximumDepth(b, level - 1)));
  }
  return vec2(low, high);
}
