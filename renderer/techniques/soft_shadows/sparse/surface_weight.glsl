// SPDX-License-Identifier: BSD-3-Clause
// How far a sample's visibility holds for another point: points are in camera space, normals too.
uniform float depthTolerance;  // of the distance along the view
uniform float normalPower;     // 0: normals do not matter
uniform mat4 anchorToCamera;

// Distance of a sample from the tangent plane of the point that wants it, in units of what is tolerated. On one plane it
// is 0 however much the plane tilts, which the difference of the depths would not be.
float planeDistance(vec3 point, vec3 normal, vec3 other) {
  return abs(dot(normal, other - point)) / max(depthTolerance * -point.z, 1e-30);
}

// 1 on the plane, falling smoothly to exactly 0 at the tolerance, so that nothing comes through from farther away.
float depthWeight(float distance) {
  const float inside = max(1.0 - distance * distance, 0.0);
  return inside * inside;
}

float normalWeight(vec3 a, vec3 b) {
  return normalPower > 0.0 ? pow(clamp(dot(a, b), 0.0, 1.0), normalPower) : 1.0;
}

vec3 cameraNormal(vec4 normal) { return mat3(anchorToCamera) * normal.xyz; }
