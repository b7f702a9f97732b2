// SPDX-License-Identifier: BSD-3-Clause
// Ambient aperture lighting: what apertureLight() of renderer/scene/lod/aperture.h states, for a small sun.

const float kPi = 3.14159265358979;

// Area between a chord of half-length w and its arc on a circle of radius r, w <= r.
float segmentArea(float r, float w) {
  const float t = asin(min(w / r, 1.0));
  // The difference of nearly equal numbers is taken by its series where t is small.
  const float difference = t < 0.3 ? t * t * t * (2.0 / 3.0 - t * t * (2.0 / 15.0 - t * t * 4.0 / 315.0))
                                   : t - 0.5 * sin(2.0 * t);
  return r * r * difference;
}

float capArea(float radius) {
  const float halfSine = sin(0.5 * radius);
  return 4.0 * kPi * halfSine * halfSine;
}

// Share of the smaller of two caps, of radius b, that lies in the larger, of radius a up to pi/2; d: angle between
// their axes. The CPU's two sectors less a kite would lose all digits to the GPU's coarse sines where b is small (the
// sun). Here: the exact segment of b that the great circle through both crossings cuts off, and the narrow segment
// between that great circle and a's rim, taken as plane with the rim's geodesic curvature 1 / tan(a): right to 1e-4
// for 3 degrees, 5e-3 for 20; to a few hundredths where the caps are of about the same size.
float smallerCapShare(float a, float b, float d) {
  if (d >= a + b) return 0.0;
  if (d <= a - b) return 1.0;
  const float halfSine = sin(0.5 * b);
  // Angle at b's axis between a's axis and a crossing of the rims: the law of cosines, without cancellation.
  const float c = clamp((2.0 * sin(0.5 * (a + d)) * sin(0.5 * (d - a)) + 2.0 * cos(d) * halfSine * halfSine) /
                            (sin(b) * sin(d)),
                        -1.0, 1.0);
  const float s = sqrt((1.0 - c) * (1.0 + c));
  // Isosceles triangle with legs b: its spherical excess.
  const float t = tan(0.5 * b) * tan(0.5 * b);
  const float excess = 2.0 * atan(t * 2.0 * s * c, 1.0 + t * (c * c - s * s));
  const float narrow = segmentArea(tan(min(a, 1.57)), b * s);
  return clamp(atan(s, c) / kPi + (narrow - excess) / capArea(b), 0.0, 1.0);
}

// Share of a cap of radius b in one of radius a.
float capShare(float a, float b, float d) {
  if (!(a > 0.0)) return 0.0;
  return a >= b ? smallerCapShare(a, b, d) : smallerCapShare(b, a, d) * capArea(a) / capArea(b);
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
