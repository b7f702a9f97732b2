// SPDX-License-Identifier: BSD-3-Clause
// A pass of recursion: a part is culled, finished, or split up to LEVELS times into points that transform feedback captures.
// See geometry_shader.cpp.
#include "renderer/techniques/recursion/recursion_bindings.h"

layout(points) in;
layout(points, max_vertices = MAX_PARTS) out;
in vec4 cornersIn[1];
in vec2 lastIn[1];
flat in uvec2 patchAndSteps[1];

// RecursionPart.
layout(xfb_buffer = 0, xfb_stride = 32) out;
layout(xfb_buffer = 0, xfb_offset = 0) out vec4 cornersOut;
layout(xfb_buffer = 0, xfb_offset = 16) out vec2 lastOut;
layout(xfb_buffer = 0, xfb_offset = 24) flat out uint patchOut;
layout(xfb_buffer = 0, xfb_offset = 28) flat out uint stepsOut;

// Storage blocks are not granted to geometry shaders.
layout(binding = kPartPointsUnit) uniform samplerBuffer patchPoints;
layout(binding = kPartPatchesUnit) uniform usamplerBuffer patchFirsts;  // first point, and whether it is a rectangle

uniform uint mostSteps;
uniform bool cull, lastPass;

vec4 patchPoint(uint i) { return texelFetch(patchPoints, int(i)); }
#include "renderer/techniques/recursion/part_flatness.glsl"

void emitPart(RecursionPart part, bool finished) {
  cornersOut = part.corners;
  lastOut = vec2(part.lastU, part.lastV);
  patchOut = part.patchNumber | (finished && !lastPass ? kPartIsFinished : 0u);
  stepsOut = part.steps;
  EmitVertex();
  EndPrimitive();
}

void main() {
  RecursionPart first = RecursionPart(cornersIn[0], lastIn[0].x, lastIn[0].y, patchAndSteps[0].x, patchAndSteps[0].y);
  if ((first.patchNumber & kPartIsFinished) != 0u) {
    first.patchNumber &= ~kPartIsFinished;
    emitPart(first, true);
    return;
  }
  const uvec2 patch_ = texelFetch(patchFirsts, int(first.patchNumber)).xy;
  const bool rectangle = patch_.y != 0u;
  RecursionPart stack[3 * LEVELS + 1];
  int size = 1;
  stack[0] = first;
  while (size > 0) {
    const RecursionPart part = stack[--size];
    if (part.steps - first.steps == uint(LEVELS)) {
      emitPart(part, false);
      continue;
    }
    const PartTest test = testOf(part, patch_.x, rectangle);
    if (cull && test.outside) continue;
    if (!test.any_ || part.steps >= mostSteps) {
      emitPart(part, true);
      continue;
    }
#ifdef HALVES
    if (rectangle) {
      for (uint i = 0u; i < 2u; ++i) stack[size++] = halfOf(part, test, i);
      continue;
    }
#endif
    for (uint i = 0u; i < 4u; ++i) stack[size++] = quarterOf(part, rectangle, i);
  }
}
