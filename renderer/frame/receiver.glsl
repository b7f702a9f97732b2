// SPDX-License-Identifier: BSD-3-Clause
// A surface point as a light's receiver: see Receivers in g_buffer.h.
#include "renderer/frame/receiver_plane.glsl"

uniform mat4 cameraToLight;

// Of a point with a normal, both in camera space; with it the gradient of its plane, see receiver_plane.glsl.
vec4 receiverAt(vec3 position, vec3 normal, out vec2 plane) {
  plane = vec2(0.0);
  const vec3 p = (cameraToLight * vec4(position, 1.0)).xyz;
  const vec3 n = mat3(cameraToLight) * normal;
  if (!(p.z > 0.0 && dot(n, p) < 0.0)) return vec4(0.0, 0.0, 0.0, -1.0);
  // On the plane n.q = n.p, depth as a function of u = x/z, v = y/z is z = n.p / n.(u,v,1).
  const float along = abs(dot(n, p / p.z));
  plane = planeGradient(p, n);
  return vec4(p, min(p.z * (abs(n.x) + abs(n.y)) / max(along, 1e-6), 1e6 * p.z));
}
