// SPDX-License-Identifier: BSD-3-Clause
// Levels from the consistent factors. See hardware.cpp. RECTANGLES: the domain is a quad.
#include "renderer/surfaces/spacing.h"
#include "renderer/techniques/tessellation/patches.glsl"

layout(vertices = 1) out;
layout(std430, binding = kFactorsBuffer) readonly buffer Factors { PatchFactors factors[]; };

in uint number[];
out uint patchNumber[];

void main() {
  patchNumber[gl_InvocationID] = number[gl_InvocationID];
  // Of a fractional spacing, the tessellator rounds and moves vertices itself. 0 culls the patch.
  const PatchFactors mine = factors[number[0]];
#ifdef FRACTIONAL
  const vec4 f = vec4(unpackedUnits(uvec2(mine.first, mine.second))) / float(kSegmentUnit);
#else
  const vec4 f = vec4(unpackedSegments(mine.segments));
#endif
#ifdef RECTANGLES
  // Outer levels: of u = 0, v = 0, u = 1, v = 1.
  gl_TessLevelOuter[0] = f.w;
  gl_TessLevelOuter[1] = f.x;
  gl_TessLevelOuter[2] = f.y;
  gl_TessLevelOuter[3] = f.z;
  gl_TessLevelInner[0] = min(f.x, f.z);
  gl_TessLevelInner[1] = min(f.y, f.w);
#else
  // Outer levels: of u = 0, v = 0, w = 0.
  gl_TessLevelOuter[0] = f.y;
  gl_TessLevelOuter[1] = f.z;
  gl_TessLevelOuter[2] = f.x;
  gl_TessLevelInner[0] = max(f.x, max(f.y, f.z));
#endif
}
