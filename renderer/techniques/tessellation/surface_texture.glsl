// SPDX-License-Identifier: BSD-3-Clause
// The texture of surfaces with texture coordinates: checks, an even number along each, so that seams from 1 to 0 do not show.

const vec2 kChecks = vec2(40.0, 24.0);

bool onDarkCheck(vec2 place) {
  const ivec2 check = ivec2(floor(place * kChecks));
  return ((check.x + check.y) & 1) != 0;
}
