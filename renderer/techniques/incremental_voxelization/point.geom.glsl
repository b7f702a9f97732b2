// SPDX-License-Identifier: BSD-3-Clause
// A point to its layer.
layout(points) in;
layout(points, max_vertices = 1) out;
layout(location = 0) flat in vec3 cornerNormal[];
layout(location = 1) flat in vec3 cornerLight[];
layout(location = 2) flat in int cornerLayer[];
layout(location = 0) flat out vec3 pointNormal;
layout(location = 1) flat out vec3 pointLight;

void main() {
  if (cornerLayer[0] < 0) return;
  pointNormal = cornerNormal[0];
  pointLight = cornerLight[0];
  gl_Position = gl_in[0].gl_Position;
  gl_PointSize = 1.0;
  gl_Layer = cornerLayer[0];
  EmitVertex();
  EndPrimitive();
}
