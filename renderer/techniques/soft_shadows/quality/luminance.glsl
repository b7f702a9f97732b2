// SPDX-License-Identifier: BSD-3-Clause
// Luminance of linear RGB with Rec. 709 primaries; white is 1. Other values than numbers from 0 on count as 0.
float relativeLuminance(vec3 rgb) {
  const vec3 held = vec3(rgb.r > 0.0 ? rgb.r : 0.0, rgb.g > 0.0 ? rgb.g : 0.0, rgb.b > 0.0 ? rgb.b : 0.0);
  return dot(held, vec3(0.2126729, 0.7151522, 0.0721750));
}
