// SPDX-License-Identifier: BSD-3-Clause
// What both images are on the display, in opponent channels; of a video, filtered in time. PUSH: reads a frame.
// FILTER: makes the finest level of the pyramids. VIDEO: frames are stored in a ring of textures, and the filters
// run over those stored.
#include "perception/metrics/color_video_vdp/gpu/cvvdp_bindings.h"

layout(local_size_x = kCvvdpLightGroupX, local_size_y = kCvvdpLightGroupY) in;

#ifdef PUSH
layout(binding = kCvvdpLightTestUnit) uniform sampler2D testImage;
layout(binding = kCvvdpLightReferenceUnit) uniform sampler2D referenceImage;
#endif
#ifdef FILTER
layout(binding = kCvvdpLightPyramidImage, rgba32f) uniform writeonly image2DArray pyramid;
#endif
#ifdef VIDEO
// A frame's six values: A, RG, YV of the test and A of the reference; RG, YV of the reference.
#ifdef PUSH
layout(binding = kCvvdpLightRingFirstImage, rgba32f) uniform writeonly image2DArray ringFirstOut;
layout(binding = kCvvdpLightRingSecondImage, rg32f) uniform writeonly image2DArray ringSecondOut;
#endif
#ifdef FILTER
layout(binding = kCvvdpLightRingFirstUnit) uniform sampler2DArray ringFirst;
layout(binding = kCvvdpLightRingSecondUnit) uniform sampler2DArray ringSecond;
layout(binding = kCvvdpWeightsBuffer, std430) readonly buffer Weights { vec4 weights[]; };  // by slot
#endif
uniform int slot;       // of the frame that is read
uniform int slots;      // that hold frames
uniform int weightRow;  // first weight of this frame
#endif

uniform ivec2 sizePx;
uniform mat3 opponentOfLight;
uniform bool grey;
uniform vec4 levels;    // span and floor of the display's light; least light and most light of clipping curves
uniform vec2 curve;     // exposure; exponent of a power or system gamma of HLG

#ifdef PUSH
vec3 lightOf(vec3 value) {
#if defined(VALUES_RELATIVE)
  return levels.x * clamp(curve.x * value, 0.0, 1.0) + levels.y;
#elif defined(EOTF_LINEAR)
  return clamp(curve.x * value, levels.z, levels.w) + levels.y;
#else
  vec3 v = clamp(value, 0.0, 1.0);
#if defined(EOTF_PQ)
  vec3 u = pow(v, vec3(1.0 / 78.84375));
  vec3 light = 10000.0 * pow(max(u - 0.8359375, 0.0) / (18.8515625 - 18.6875 * u), vec3(1.0 / 0.1593017578125));
  return clamp(curve.x * light, levels.z, levels.w) + levels.y;
#else
#if defined(EOTF_SRGB)
  vec3 relative = mix(v / 12.92, pow((v + 0.055) / 1.055, vec3(2.4)), greaterThan(v, vec3(0.04045)));
#elif defined(EOTF_POWER)
  vec3 relative = pow(v, vec3(curve.y));
#elif defined(EOTF_HLG)
  const float kA = 0.17883277, kB = 1.0 - 4.0 * kA, kC = 0.55991073;
  vec3 scene = mix(v * v / 3.0, (exp((v - kC) / kA) + kB) / 12.0, greaterThan(v, vec3(0.5)));
  float luminance = dot(scene, vec3(0.2627, 0.6780, 0.0593));
  vec3 relative = luminance > 0.0 ? pow(luminance, curve.y - 1.0) * scene : vec3(0.0);
#endif
  if (curve.x != 1.0) relative = clamp(curve.x * relative, 0.0, 1.0);
  return levels.x * relative + levels.y;
#endif
#endif
}

// By the bits, since a compiler may take isnan() for false.
bvec3 isNonFinite(vec3 v) { return equal(floatBitsToUint(v) & 0x7f800000u, uvec3(0x7f800000u)); }

vec3 opponentOf(vec3 value) {
  precise vec3 light = lightOf(value);
  precise vec3 opponent = fma(opponentOfLight[2], light.zzz, fma(opponentOfLight[1], light.yyy, opponentOfLight[0] * light.x));
  return opponent;
}
#endif

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
#ifdef PUSH
  vec3 testValue = texelFetch(testImage, pixel, 0).rgb;
  vec3 referenceValue = texelFetch(referenceImage, pixel, 0).rgb;
  if (grey) testValue = testValue.rrr, referenceValue = referenceValue.rrr;
  // Whatever is no number counts as black or white, whichever is farther from the reference.
  referenceValue = mix(referenceValue, vec3(0.0), isNonFinite(referenceValue));
  testValue = mix(testValue, vec3(lessThan(referenceValue, vec3(0.5))), isNonFinite(testValue));
  precise vec3 test = opponentOf(testValue), reference = opponentOf(referenceValue);
#endif
#ifdef VIDEO
#ifdef PUSH
  imageStore(ringFirstOut, ivec3(pixel, slot), vec4(test, reference.x));
  imageStore(ringSecondOut, ivec3(pixel, slot), vec4(reference.yz, 0.0, 0.0));
#endif
#ifdef FILTER
  precise vec4 testSum = vec4(0.0), referenceSum = vec4(0.0);
#ifdef PUSH
  precise vec4 own = weights[weightRow + slot];
  testSum = own * test.xyzx, referenceSum = own * reference.xyzx;
#endif
  for (int s = 0; s < slots; ++s) {
#ifdef PUSH
    if (s == slot) continue;
#endif
    vec4 weight = weights[weightRow + s];
    vec4 first = texelFetch(ringFirst, ivec3(pixel, s), 0);
    vec2 second = texelFetch(ringSecond, ivec3(pixel, s), 0).xy;
    testSum = fma(weight, first.xyzx, testSum);
    referenceSum = fma(weight, vec4(first.w, second, first.w), referenceSum);
  }
#endif
#elif defined(FILTER)
  vec4 testSum = vec4(test, 0.0), referenceSum = vec4(reference, 0.0);
#endif
#ifdef FILTER
  imageStore(pyramid, ivec3(pixel, 0), testSum);
  imageStore(pyramid, ivec3(pixel, 1), referenceSum);
#endif
}
