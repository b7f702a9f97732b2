// SPDX-License-Identifier: BSD-3-Clause
// A shape or a picture at a place of the screen, which is the viewport. Row 0 of the window is its lowest.
#include "study/presentation/screen_bindings.h"

layout(binding = kScreenPicturesUnit) uniform sampler2DArray pictures;
layout(location = 0) out vec4 colour;
uniform int shape;  // 0 picture, 1 filled, 2 ring, 3 arrow that points down
uniform int layer;
uniform ivec2 lowPx, sizePx;  // of the viewport, window coordinates
uniform vec2 ringPx;          // radius and width
uniform float value;          // grey as the display takes it

void main() {
  const ivec2 local = ivec2(gl_FragCoord.xy) - lowPx;
  const ivec2 pixel = ivec2(local.x, sizePx.y - 1 - local.y);  // row 0 at the top
  if (shape == 0) {
    colour = texelFetch(pictures, ivec3(pixel, layer), 0);
    return;
  }
  const vec2 at = vec2(pixel) + 0.5, extent = vec2(sizePx);
  if (shape == 2) {
    const float radius = distance(at, 0.5 * extent);
    if (abs(radius - ringPx.x) > 0.5 * ringPx.y) discard;
  }
  if (shape == 3) {
    // The lower two fifths are the head, the rest the shaft.
    const float aside = abs(at.x - 0.5 * extent.x), above = extent.y - at.y;
    const bool head = above < 0.4 * extent.y && aside < 0.6 * above;
    const bool shaft = above >= 0.4 * extent.y && aside < 0.07 * extent.y;
    if (!head && !shaft) discard;
  }
  colour = vec4(vec3(value), 1.0);
}
