// SPDX-License-Identifier: BSD-3-Clause
// Marks pixels whose shading changes over time about as much as between the levels of detail.
#include "perception/popping/gpu/popping_bindings.h"
#include "perception/popping/gpu/previous_place.glsl"

layout(local_size_x = kPoppingGroupX, local_size_y = kPoppingGroupY) in;

layout(binding = kFlickerActualUnit) uniform sampler2D actual;
layout(binding = kFlickerPredictedUnit) uniform sampler2D predicted;
layout(binding = kFlickerPreviousShadingUnit) uniform sampler2D previousShading;
layout(binding = kFlickerPreviousFrameUnit) uniform sampler2D previousFrame;
layout(binding = kFlickerDisplacementUnit) uniform sampler2D displacement;
layout(binding = kFlickerDepthOfPixelUnit) uniform sampler2D depthOfPixel;
layout(binding = kFlickerPreviousDepthUnit) uniform sampler2D previousDepth;
layout(binding = kFlickerWeightsImage, r32f) uniform writeonly image2D weights;

uniform int compareDepth;
uniform float kappa, largestDisplacement, flickerWeight, depthTolerance;

vec3 finite(vec3 value) {
  for (int c = 0; c < 3; ++c)
    if (isnan(value[c]) || isinf(value[c])) value[c] = 0.0;
  return value;
}

float labCurve(float t) {
  const float kDelta = 6.0 / 29.0;
  return t > kDelta * kDelta * kDelta ? pow(t, 1.0 / 3.0) : t / (3.0 * kDelta * kDelta) + 4.0 / 29.0;
}

// CIELAB of linear RGB, held to what a display can show.
vec3 labOf(vec3 rgb) {
  const mat3 kXyzOverWhite = mat3(10135552.0 / 23359437.0, 2613072.0 / 12288897.0, 1425312.0 / 80288307.0,
                                  8788810.0 / 23359437.0, 8788810.0 / 12288897.0, 8788810.0 / 80288307.0,
                                  4435075.0 / 23359437.0, 887015.0 / 12288897.0, 70074185.0 / 80288307.0);
  vec3 xyz = kXyzOverWhite * clamp(rgb, 0.0, 1.0);
  vec3 f = vec3(labCurve(xyz.x), labCurve(xyz.y), labCurve(xyz.z));
  return vec3(116.0 * f.y - 16.0, 500.0 * (f.x - f.y), 200.0 * (f.y - f.z));
}

// CIE94 for graphic arts.
float difference(vec3 reference, vec3 test) {
  float referenceChroma = length(reference.yz), chroma = referenceChroma - length(test.yz);
  vec3 delta = reference - test;
  float hueSquared = max(0.0, dot(delta.yz, delta.yz) - chroma * chroma);
  float chromaScale = 1.0 + 0.045 * referenceChroma, hueScale = 1.0 + 0.015 * referenceChroma;
  return sqrt(delta.x * delta.x + chroma * chroma / (chromaScale * chromaScale) +
              hueSquared / (hueScale * hueScale));
}

bool flickers(ivec2 pixel) {
  ivec2 size = textureSize(previousFrame, 0);
  vec2 place = previousPlace(pixel, texelFetch(displacement, pixel, 0).xy);
  if (distance(place, vec2(pixel) + 0.5) >= largestDisplacement || !isInside(place, size)) return false;
  float depth = compareDepth != 0 ? texelFetch(depthOfPixel, pixel, 0).x : 0.0;
  Corners corners = cornersAround(place);
  vec3 colour = vec3(0.0);
  float weightSum = 0.0;
  for (int corner = 0; corner < 4; ++corner) {
    ivec2 texel = cornerTexel(corners, corner, size);
    if (compareDepth != 0) {
      float there = texelFetch(previousDepth, texel, 0).x;
      bool background = !(depth > 0.0), backgroundThere = !(there > 0.0);
      if (background != backgroundThere) continue;
      if (!background && abs(there - depth) > depthTolerance * depth) continue;
    }
    float weight = cornerWeight(corners, corner);
    weightSum += weight;
    colour += weight * finite(texelFetch(previousFrame, texel, 0).xyz);
  }
  if (!(weightSum > 0.0)) return false;
  vec3 actualColour = finite(texelFetch(actual, pixel, 0).xyz);
  vec3 predictedColour = finite(texelFetch(predicted, pixel, 0).xyz);
  if (actualColour == predictedColour) return false;
  float overTime = difference(labOf(colour / weightSum), labOf(finite(texelFetch(previousShading, pixel, 0).xyz)));
  float overLod = difference(labOf(actualColour), labOf(predictedColour));
  return overLod > 0.0 && overTime >= kappa * overLod;
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(weights)))) return;
  imageStore(weights, pixel, vec4(flickers(pixel) ? flickerWeight : 1.0));
}
