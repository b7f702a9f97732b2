// SPDX-License-Identifier: BSD-3-Clause
// Coordinates in which a ray and a triangle are tested: Woop, Benthin and Wald 2013. See trace.glsl.
struct RayShear {
  int axis;  // along which the direction is longest
  vec3 by;   // the shear of the other two, and the scale
};

vec3 rayPermuted(vec3 v, int axis) { return axis == 2 ? v : axis == 0 ? v.yzx : v.zxy; }

vec2 raySheared(vec3 v, vec3 by) { return vec2(fma(-by.x, v.z, v.x), fma(-by.y, v.z, v.y)); }

// Rounded products first: their order is that of the exact ones, or they are equal.
float rayEdge(vec2 a, vec2 b) {
  precise const float left = a.x * b.y, right = a.y * b.x;
  precise const float side = left - right;
  return side;
}

// Of a direction that is not 0.
RayShear rayShear(vec3 direction) {
  const vec3 size = abs(direction);
  RayShear shear;
  shear.axis = size.z >= size.x && size.z >= size.y ? 2 : size.x >= size.y ? 0 : 1;
  const vec3 turned = rayPermuted(direction, shear.axis);
  shear.by = vec3(turned.xy, 1.0) / turned.z;
  return shear;
}
