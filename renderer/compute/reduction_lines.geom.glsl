// SPDX-License-Identifier: BSD-3-Clause
// Splits a block's line where it passes the end of a row. See reduction_lines.vert.glsl.
#include "renderer/compute/line_end.glsl"

layout(lines) in;
layout(line_strip, max_vertices = 4) out;
flat in uint shift[];
flat in uvec2 segment[];
flat out uint itemShift;
uniform uint rowWidth, rows;

void emitLine(uint first, uint end, uint row) {
  for (int i = 0; i < 2; ++i) {
    gl_Position = lineEnd(uvec2(i == 0 ? first : end, row), rowWidth, rows);
    itemShift = shift[0];
    EmitVertex();
  }
  EndPrimitive();
}

void main() {
  if (segment[0].y == 0u) return;
  const uint column = segment[0].x % rowWidth, row = segment[0].x / rowWidth, end = column + segment[0].y;
  emitLine(column, min(end, rowWidth), row);
  if (end > rowWidth) emitLine(0u, end - rowWidth, row + 1u);
}
