// SPDX-License-Identifier: BSD-3-Clause
// Share of the light's rectangle that lies before the receiver's own plane. Needs shadow_lookup.glsl.
#ifdef BIAS_PLANE
// Share of the unit square with a . s < limit: the integral over y of a clamped line, in closed form.
float shareBefore(vec2 a, float limit) {
  // Mirrored so that both components are positive.
  if (a.x < 0.0) a.x = -a.x, limit += a.x;
  if (a.y < 0.0) a.y = -a.y, limit += a.y;
  const float low = min(a.x, a.y), high = max(a.x, a.y);
  if (limit <= 0.0) return 0.0;
  if (limit >= low + high) return 1.0;
  if (limit < low) return 0.5 * limit * limit / (low * high);
  if (limit > high) return 1.0 - 0.5 * (low + high - limit) * (low + high - limit) / (low * high);
  return (limit - 0.5 * low) / high;
}
// A point (s - eye) lightSize of the light is behind the plane if g . point >= p_z.
float shareBeforePlane(vec4 p) {
  if (!planeCutsLight(p)) return 1.0;
  const vec2 perUnit = receiverPlane * lightSize;
  return shareBefore(perUnit, p.z + dot(perUnit, eyeOnLight));
}
#else
float shareBeforePlane(vec4 p) { return 1.0; }
#endif
