// SPDX-License-Identifier: BSD-3-Clause
// The middle of a texel in a viewport of 2 rowWidth x rows, so wide that a line may end beyond the row: it covers all texels
// from its start up to, but without, the one that it ends in.
vec4 lineEnd(uvec2 texel, uint rowWidth, uint rows) {
  const vec2 middle = (vec2(texel) + 0.5) / vec2(rowWidth, rows);
  return vec4(middle.x - 1.0, 1.0 - 2.0 * middle.y, 0.5, 1.0);
}
