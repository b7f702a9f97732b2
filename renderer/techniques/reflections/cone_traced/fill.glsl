// SPDX-License-Identifier: BSD-3-Clause
// What a cone shows where nothing covers it (Roger 2008, section 5.2.4). The rest of 1 - alpha is the background.
#ifdef ENVIRONMENT
layout(binding = kConeEnvironmentUnit) uniform samplerCube environment;
uniform float environmentTexels;  // along a quarter of a circle
#endif

vec4 filled(vec3 sum, float covered, vec3 direction, float growth) {
#if defined(RESCALED)
  return covered > 0.0 ? vec4(sum / covered, 1.0) : vec4(0.0);
#elif defined(ENVIRONMENT)
  // Nothing where there is no direction, for which a driver may read anywhere.
  if (!(dot(direction, direction) > 0.0 && growth >= 0.0) || isinf(dot(direction, direction))) return vec4(sum, 1.0);
  // A texel as wide as the cone.
  const float level = log2(max(2.0 * atan(growth) * environmentTexels / 1.5707963, 1.0));
  return vec4(sum + max(1.0 - covered, 0.0) * textureLod(environment, direction, level).rgb, 1.0);
#elif defined(UNFILLED)
  return vec4(sum, 1.0);
#else
  return vec4(sum, covered);
#endif
}
