// SPDX-License-Identifier: BSD-3-Clause
// Share of light that comes along a ray, traced. After occlusion_rays.glsl and object_trace.glsl.
float tracedVisibility(FieldReceiver receiver, vec3 direction) {
  if (falloff == kFalloffBinary) return isBlocked(receiver, direction, falloffRadius) ? 0.0 : 1.0;
  const float nearest = tracedDistance(receiver, direction);
  return nearest < 0.0 ? 1.0 : visibilityAt(nearest);
}
