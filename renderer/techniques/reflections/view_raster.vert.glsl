// SPDX-License-Identifier: BSD-3-Clause
// Triangles of the scene in any view, cut by a plane. See view_raster.h.
layout(location = 0) in vec3 position;
layout(location = 1) in uint firstTriangle;
uniform mat4 anchorToClip;
uniform vec4 clipPlane;
flat out uint first;
out float gl_ClipDistance[1];

void main() {
  gl_Position = anchorToClip * vec4(position, 1.0);
  gl_ClipDistance[0] = dot(clipPlane, vec4(position, 1.0));
  first = firstTriangle;
}
