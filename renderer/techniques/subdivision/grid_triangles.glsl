// SPDX-License-Identifier: BSD-3-Clause
// Triangles of a uniformly divided patch: places of the corners of the one with this number. CORNERS: 3 or 4.

ivec2[3] gridTriangle(uint number, int segments) {
#if CORNERS == 3
  // Row y has 2 (n - y) - 1 triangles: those before it are y (2 n - y).
  int y = clamp(int(float(segments) - sqrt(float(uint(segments * segments) - number))), 0, segments - 1);
  while (y > 0 && uint(y * (2 * segments - y)) > number) --y;
  while (uint((y + 1) * (2 * segments - y - 1)) <= number) ++y;
  const int inRow = int(number) - y * (2 * segments - y), x = inRow / 2;
  if (inRow % 2 == 0) return ivec2[3](ivec2(x, y), ivec2(x + 1, y), ivec2(x, y + 1));
  return ivec2[3](ivec2(x + 1, y), ivec2(x + 1, y + 1), ivec2(x, y + 1));
#else
  const ivec2 cell = ivec2(int(number / 2u) % segments, int(number / 2u) / segments);
  if (number % 2u == 0u) return ivec2[3](cell, cell + ivec2(1, 0), cell + ivec2(1));
  return ivec2[3](cell, cell + ivec2(1), cell + ivec2(0, 1));
#endif
}
