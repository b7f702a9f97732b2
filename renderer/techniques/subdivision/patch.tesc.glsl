// SPDX-License-Identifier: BSD-3-Clause
// Main step in the tessellation stages: the same number of segments, a power of two, along all sides.
layout(vertices = 1) out;
flat in uint patchOfVertex[];
patch out uint patchNumber;
uniform int segments;

void main() {
  patchNumber = patchOfVertex[0];
  for (int i = 0; i < 4; ++i) gl_TessLevelOuter[i] = float(segments);
  for (int i = 0; i < 2; ++i) gl_TessLevelInner[i] = float(segments);
}
