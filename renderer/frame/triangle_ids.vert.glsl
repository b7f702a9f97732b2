// SPDX-License-Identifier: BSD-3-Clause
layout(location = 0) in vec3 position;
layout(location = 1) in uint firstTriangle;
uniform mat4 anchorToClip;
flat out uint first;

void main() {
  gl_Position = anchorToClip * vec4(position, 1.0);
  first = firstTriangle;
}
