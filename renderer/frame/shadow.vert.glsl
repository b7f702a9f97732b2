// SPDX-License-Identifier: BSD-3-Clause
layout(location = 0) in vec3 position;
uniform mat4 anchorToClip;

void main() { gl_Position = anchorToClip * vec4(position, 1.0); }
