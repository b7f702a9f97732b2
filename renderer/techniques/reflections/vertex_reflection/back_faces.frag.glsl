// SPDX-License-Identifier: BSD-3-Clause
// Depth of a reflector's back faces alone, by the order of their vertices.
#include "renderer/frame/scene_buffers.glsl"

flat in uint first;
uniform vec3 eyeRelative;  // to the scene's anchor

void main() {
  const uvec3 corners = sceneTriangle(first + uint(gl_PrimitiveID));
  const vec3 a = scenePosition(corners.x), b = scenePosition(corners.y), c = scenePosition(corners.z);
  if (dot(cross(b - a, c - a), eyeRelative - a) > 0.0) discard;
}
