// SPDX-License-Identifier: BSD-3-Clause
// Products as a viewer sees them on the display.
layout(binding = kShowAlbedoUnit) uniform sampler2D albedo;
layout(binding = kShowDirectUnit) uniform sampler2D direct;
uniform int grey;     // one channel
uniform int isShare;  // of the direct light; else the light itself
uniform float exposure, ambient, diffuse, background;

vec3 channels(vec4 texel) { return grey != 0 ? texel.xxx : texel.xyz; }

// A value that is not finite shows whichever of 0 and 1 is farther from the reference.
vec3 sound(vec3 value, vec3 reference) {
  for (int c = 0; c < 3; ++c)
    if (isnan(value[c]) || isinf(value[c])) value[c] = reference[c] < 0.5 ? 1.0 : 0.0;
  return value;
}

// Rounded alike wherever it is inlined, so that equal products are shown equally.
vec3 shown(vec3 value, ivec2 pixel) {
  precise vec3 light = value;
  if (isShare != 0) {
    const vec4 reflected = texelFetch(albedo, pixel, 0);
    light = reflected.x < 0.0 ? vec3(background)
                              : fma(diffuse * value, texelFetch(direct, pixel, 0).xyz, ambient * reflected.xyz);
  }
  return clamp(exposure * light, 0.0, 1.0);
}
