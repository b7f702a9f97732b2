// SPDX-License-Identifier: BSD-3-Clause
// Only what lies within the slice; a slice holds its near plane, the last one both.
layout(location = 0) in float depth;
layout(location = 1) flat in vec2 range;
layout(location = 0) out float occupied;

void main() {
  if (!(depth >= range.x && depth < range.y)) discard;
  occupied = 1.0;
}
