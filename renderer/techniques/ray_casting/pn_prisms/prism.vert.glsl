// SPDX-License-Identifier: BSD-3-Clause
layout(location = 0) in vec3 position;
layout(location = 1) in uint patchNumber;
layout(location = 2) in vec2 start;
uniform mat4 anchorToClip;
flat out uint patch_;
out vec2 startBelow;

void main() {
  gl_Position = anchorToClip * vec4(position, 1.0);
  patch_ = patchNumber;
  startBelow = start;
}
