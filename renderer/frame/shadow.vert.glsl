// SPDX-License-Identifier: BSD-3-Clause
layout(location = 0) in vec3 position;
uniform mat4 anchorToClip;
// A surface has one depth, whether or not others are peeled off.
invariant gl_Position;

void main() { gl_Position = anchorToClip * vec4(position, 1.0); }
