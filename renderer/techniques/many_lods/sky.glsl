// SPDX-License-Identifier: BSD-3-Clause
// Radiance of the environment from the unit vector `towards`. See sky.h.
uniform vec4 skyLayers;  // zenith, horizon, ground, sun
uniform vec3 sunDirection;
uniform float sunSharpness;

float skyRadiance(vec3 towards) {
  const float base = towards.y >= 0.0 ? mix(skyLayers.y, skyLayers.x, towards.y) : skyLayers.z;
  return base + skyLayers.w * exp((dot(towards, sunDirection) - 1.0) * sunSharpness);
}
