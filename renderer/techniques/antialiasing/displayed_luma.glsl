// SPDX-License-Identifier: BSD-3-Clause
// Lightness of a linear colour as a display shows it, 0..1: what filters of finished pictures look for edges in. The
// including shader declares the sampler `colours` and `sizePx` before.

float displayed(float linear) {
  const float x = clamp(linear, 0.0, 1.0);
  return x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1.0 / 2.4) - 0.055;
}

vec3 colourAt(ivec2 pixel) { return texelFetch(colours, clamp(pixel, ivec2(0), sizePx - 1), 0).rgb; }

float lumaAt(ivec2 pixel) {
  const vec3 colour = colourAt(pixel);
  return dot(vec3(displayed(colour.r), displayed(colour.g), displayed(colour.b)), vec3(0.299, 0.587, 0.114));
}
