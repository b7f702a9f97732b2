// SPDX-License-Identifier: BSD-3-Clause
// Where a triangle in clip space covers a place of the picture, and at which depth: the test that every pass of the compute
// rasterisers shares, so that their results agree to the bit. See compute_raster.h.
#include "renderer/frame/scene_buffers.glsl"

uniform mat4 anchorToClip;
uniform float near;
uniform ivec2 sizePx;

// Clip space x, y, w.
vec3 clipPosition(uint vertex) {
  precise const vec4 clip = anchorToClip * vec4(scenePosition(vertex), 1.0);
  return clip.xyw;
}

float product(vec2 a, vec2 b) {
  precise const float result = a.x * b.y - a.y * b.x;
  return result;
}

// Whether the triangle covers a place, in pixels from the picture's top left corner; if so, near / distance there.
bool covers(vec3 cornerA, vec3 cornerB, vec3 cornerC, vec2 place, out float depth) {
  const vec2 ndc = vec2(2.0, -2.0) * place / vec2(sizePx) + vec2(-1.0, 1.0);
  precise const vec2 a = cornerA.xy - ndc * cornerA.z, b = cornerB.xy - ndc * cornerB.z, c = cornerC.xy - ndc * cornerC.z;
  const float u = product(b, c), v = product(c, a), w = product(a, b);
  const bool positive = u >= 0.0 && v >= 0.0 && w >= 0.0, negative = u <= 0.0 && v <= 0.0 && w <= 0.0;
  precise const float sum = u + v + w;
  depth = 0.0;
  if (!(positive || negative) || sum == 0.0) return false;
  precise const float distance = (u * cornerA.z + v * cornerB.z + w * cornerC.z) / sum;
  if (!(distance >= near)) return false;
  precise const float result = near / distance;
  depth = result;
  return true;
}
