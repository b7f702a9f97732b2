// SPDX-License-Identifier: BSD-3-Clause
// A part as it was captured. See geometry_shader.cpp.
layout(location = 0) in vec4 corners;
layout(location = 1) in vec2 last;
layout(location = 2) in uint patchNumber;
layout(location = 3) in uint steps;
out vec4 cornersIn;
out vec2 lastIn;
flat out uvec2 patchAndSteps;

void main() {
  cornersIn = corners;
  lastIn = last;
  patchAndSteps = uvec2(patchNumber, steps);
}
