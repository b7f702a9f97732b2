// SPDX-License-Identifier: BSD-3-Clause
// Ambient aperture lighting: the same as capIntersection() and apertureLight() of renderer/scene/lod/aperture.cpp,
// where the derivations stand.

const float kPi = 3.14159265358979;

float capArea(float radius) {
  const float half_ = sin(0.5 * radius);
  return 4.0 * kPi * half_ * half_;
}

float cornerAngle(float s, float a, float b, float c) {
  return 2.0 * atan(sqrt(max(sin(s - b) * sin(s - c), 0.0)), sqrt(max(sin(s) * sin(s - a), 0.0)));
}

// Share of a cap of radius b that lies in a cap of radius a; d: angle between their axes.
float capShare(float a, float b, float d) {
  if (d >= a + b) return 0.0;
  if (d <= a - b) return 1.0;
  const float whole = capArea(b);
  if (d <= b - a) return capArea(a) / whole;
  const float s = 0.5 * (a + b + d);
  const float product = tan(0.5 * s) * tan(0.5 * (s - a)) * tan(0.5 * (s - b)) * tan(0.5 * (s - d));
  const float excess = 4.0 * atan(sqrt(max(product, 0.0)));
  const float shared_ = (cornerAngle(s, b, a, d) * capArea(a) + cornerAngle(s, a, b, d) * whole) / kPi - 2.0 * excess;
  return clamp(shared_ / whole, 0.0, 1.0);
}

// (share of the sun's disc in the cone, irradiance of a uniform sky through it over that of the whole sky).
// `aperture`: axis, not yet of length 1, and angle.
vec2 apertureLight(vec4 aperture, vec3 normal, vec3 toSun, float sunRadius) {
  const float reach = length(aperture.xyz);
  const vec3 axis = reach > 0.0 ? aperture.xyz / reach : normal;
  const float between = atan(length(cross(axis, toSun)), dot(axis, toSun));
  const float s = sin(aperture.w);
  return vec2(capShare(aperture.w, max(sunRadius, 1e-5), between), s * s * max(dot(normal, axis), 0.0));
}
