// SPDX-License-Identifier: BSD-3-Clause
// The scene around a reflector's centre, for one face of a cube map.
layout(location = 0) in vec3 position;
layout(location = 1) in uint firstTriangle;
uniform mat4 anchorToFace;
uniform vec3 faceCentre;
out vec3 fromCentre;
flat out uint first;

void main() {
  fromCentre = position - faceCentre;
  first = firstTriangle;
  gl_Position = anchorToFace * vec4(position, 1.0);
}
