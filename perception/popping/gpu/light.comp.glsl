// SPDX-License-Identifier: BSD-3-Clause
// Pixel values of both frames to cone responses, level 0 of their pyramids; alpha: speed in pixels per frame. Marks
// pixels whose colours differ.
#include "perception/popping/gpu/popping_bindings.h"

layout(local_size_x = kPoppingGroupX, local_size_y = kPoppingGroupY) in;

layout(binding = kLightActualUnit) uniform sampler2D actual;
layout(binding = kLightPredictedUnit) uniform sampler2D predicted;
layout(binding = kLightActualDisplacementUnit) uniform sampler2D actualDisplacement;
layout(binding = kLightPredictedDisplacementUnit) uniform sampler2D predictedDisplacement;
layout(binding = kLightConesImage, rgba32f) uniform writeonly image2DArray cones;  // layer: 0 actual, 1 predicted
layout(binding = kLightSeedsImage, r8ui) uniform writeonly uimage2D seeds;
layout(binding = kPoppingCountersBuffer, std430) buffer Counters { PoppingCounters counters; };

uniform int frameCount;  // 2; a uniform, so that both frames go through the same code, not through copies of it
uniform int grey, transfer, hasDisplacement, everySeed;
uniform float displayGamma;
uniform mat3 conesOfLight;  // linear RGB to absolute cone responses
uniform vec3 conesOfBlack;

const float kBrightest = 1e6, kFarthestPx = 1e6;
shared uint groupFlushed;

float finite(float value) { return isnan(value) || isinf(value) ? 0.0 : value; }

float decode(float value) {
  if (transfer == 2) return clamp(value, 0.0, kBrightest);
  float u = clamp(value, 0.0, 1.0);
  if (transfer == 1) return u > 0.0 ? pow(u, displayGamma) : 0.0;
  return u <= 0.04045 ? u / 12.92 : pow((u + 0.055) / 1.055, 2.4);
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  bool inside = all(lessThan(pixel, imageSize(cones).xy));
  if (gl_LocalInvocationIndex == 0u) groupFlushed = 0u;
  barrier();
  uint flushedHere = 0u;
  vec3 before = vec3(0.0);
  bool differs = false;
  for (int frame = 0; frame < frameCount && inside; ++frame) {
    vec3 value = frame == 0 ? texelFetch(actual, pixel, 0).xyz : texelFetch(predicted, pixel, 0).xyz;
    if (grey != 0) value.yz = value.xx;
    for (int c = 0; c < 3; ++c) {
      if (isnan(value[c]) || isinf(value[c])) {
        if (grey == 0 || c == 0) ++flushedHere;
        value[c] = 0.0;
      }
    }
    differs = differs || (frame == 1 && value != before);
    before = value;
    precise vec3 light = vec3(decode(value.x), decode(value.y), decode(value.z));
    precise vec3 response = fma(conesOfLight[2], light.zzz,
                                fma(conesOfLight[1], light.yyy, fma(conesOfLight[0], light.xxx, conesOfBlack)));
    float speedPx = 0.0;
    if (hasDisplacement != 0) {
      vec2 move = frame == 0 ? texelFetch(actualDisplacement, pixel, 0).xy
                             : texelFetch(predictedDisplacement, pixel, 0).xy;
      for (int c = 0; c < 2; ++c) {
        if (isnan(move[c]) || isinf(move[c])) ++flushedHere;
        move[c] = clamp(finite(move[c]), -kFarthestPx, kFarthestPx);
      }
      speedPx = length(move);
    }
    imageStore(cones, ivec3(pixel, frame), vec4(response, speedPx));
  }
  if (inside) imageStore(seeds, pixel, uvec4(differs || everySeed != 0 ? 1u : 0u));
  if (flushedHere != 0u) atomicAdd(groupFlushed, flushedHere);
  barrier();
  if (gl_LocalInvocationIndex == 0u && groupFlushed != 0u) atomicAdd(counters.flushed, groupFlushed);
}
