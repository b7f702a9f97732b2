// SPDX-License-Identifier: BSD-3-Clause
// A receiver's own plane as a shadow map sees it. On the plane n.q = n.p, 1/z is linear in the tangents u = x/z, v = y/z:
//   1 / z = (1 + g . (u - p_x/p_z, v - p_y/p_z)) / p_z,   g = n.xy / (n . p / p_z).
// n.p < 0 if the map's eye lies before the plane; otherwise the plane is of no use to a bias, and g = 0.
vec2 planeGradient(vec3 p, vec3 n) {
  const float along = dot(n, p / p.z);
  return along < 0.0 ? clamp(n.xy / min(along, -1e-6), vec2(-1e6), vec2(1e6)) : vec2(0.0);
}

// The same for an eye that may lie behind the plane, for tests that know on which side it is.
vec2 planeGradientFromEitherSide(vec3 p, vec3 n) {
  const float along = dot(n, p / p.z);
  return clamp(n.xy / (along < 0.0 ? min(along, -1e-6) : max(along, 1e-6)), vec2(-1e6), vec2(1e6));
}
