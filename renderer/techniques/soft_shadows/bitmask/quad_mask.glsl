// SPDX-License-Identifier: BSD-3-Clause
// Masks of backprojected microquads and microtris. QUAD_MASK_APPROXIMATE: a rectangle in place of the quad (Schwarz
// 2009, section 4.4.2); _HALF_SPACE_TABLE and _ARITHMETIC: the convex hull (section 4.4.4).
#if QUAD_MASK == QUAD_MASK_APPROXIMATE
// Bounds at the middles of the edges of the quad clamped to the light. Neighbours that share an edge share that bound.
void addQuadToMask(vec2 a, vec2 b, vec2 c, vec2 d) {
  // Clamped in an order that turns a NaN into a bound.
  a = min(max(a, vec2(0.0)), vec2(1.0));
  b = min(max(b, vec2(0.0)), vec2(1.0));
  c = min(max(c, vec2(0.0)), vec2(1.0));
  d = min(max(d, vec2(0.0)), vec2(1.0));
  const vec2 start = 0.5 * vec2(a.x + d.x, a.y + b.y), end = 0.5 * vec2(b.x + c.x, d.y + c.y);
  const vec2 low = min(start, end), high = max(start, end);
  if (low.x < high.x && low.y < high.y) addToMask(low, high);
}
#else
#include "renderer/techniques/soft_shadows/bitmask/convex_hull.glsl"
#if QUAD_MASK == QUAD_MASK_HALF_SPACE_TABLE
#include "renderer/techniques/soft_shadows/bitmask/half_space_table.glsl"
#else
#include "renderer/techniques/soft_shadows/bitmask/hull_rows.glsl"
#endif
#endif
