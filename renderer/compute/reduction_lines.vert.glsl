// SPDX-License-Identifier: BSD-3-Clause
// Blocks as lines of texels (Roger 2008, section 4.3.3). TWICE: four vertices a block, the part up to the end of its row and the
// rest in the next; otherwise two vertices, and a geometry shader splits.
#include "renderer/compute/reduction_bindings.h"
#include "renderer/compute/line_end.glsl"

layout(binding = kReductionSumsUnit) uniform usamplerBuffer sums;  // invalid items before each block
uniform uint rowWidth, rows;  // of the viewport: twice and once its size, both powers of two

flat out uint shift;
#ifndef TWICE
flat out uvec2 segment;  // first texel, texels
#endif

void main() {
#ifdef TWICE
  const uint block = uint(gl_VertexID) / 4u;
#else
  const uint block = uint(gl_VertexID) / 2u;
#endif
  shift = texelFetch(sums, int(block)).x;
  const uint length_ = uint(BLOCK) - (texelFetch(sums, int(block) + 1).x - shift);
  const uint start = block * uint(BLOCK) - shift;
#ifdef TWICE
  const uint column = start % rowWidth, row = start / rowWidth, end = column + length_;
  const bool isRest = (gl_VertexID & 2) != 0, isEnd = (gl_VertexID & 1) != 0;
  const bool empty = isRest ? end <= rowWidth : length_ == 0u;
  const uint x = isRest ? (isEnd ? end - rowWidth : 0u) : (isEnd ? min(end, rowWidth) : column);
  gl_Position = empty ? vec4(-2.0, -2.0, -2.0, 1.0) : lineEnd(uvec2(x, isRest ? row + 1u : row), rowWidth, rows);
#else
  segment = uvec2(start, length_);
  gl_Position = vec4(0.0);
#endif
}
