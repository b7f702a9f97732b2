// SPDX-License-Identifier: BSD-3-Clause
// Light samples hidden by the triangles between each receiver and the light. Classes and counts as in shadow_lookup.glsl,
// which is about shadow maps; there is none here.
#include "renderer/techniques/soft_shadows/triangle_bitmask/triangle_bitmask_bindings.h"
#include "renderer/techniques/soft_shadows/bitmask/occlusion_mask.glsl"
#include "renderer/techniques/soft_shadows/triangle_bitmask/triangle_bvh.glsl"
#include "renderer/techniques/soft_shadows/triangle_bitmask/triangle_mask.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kTriangleBitmaskReceiversUnit) uniform sampler2D receivers;
layout(binding = kTriangleBitmaskIdsUnit) uniform usampler2D triangleIds;
layout(binding = kTriangleBitmaskVisibilityImage, r32f) uniform writeonly image2D outVisibility;
// Of the scene's triangles: unit normal and n . q on the plane; no normal where a triangle has no area. Worked out in double
// precision: corners rounded to float would turn a sliver.
layout(std430, binding = kTriangleBitmaskPlanesBuffer) readonly buffer Planes { vec4 planes[]; };
layout(std430, binding = kTriangleBitmaskLightShapeBuffer) readonly buffer LightShape { uint lightShape[MASK_WORDS]; };  // samples that lie on the light
#ifdef COUNT
layout(binding = kTriangleBitmaskCountsImage, rgba32ui) uniform writeonly uimage2D outCounts;
layout(std430, binding = kTriangleBitmaskMasksBuffer) writeonly buffer Masks { uint outMasks[]; };
#endif

uniform ivec2 sizePx;
uniform vec2 lightSize;  // all lengths are shares of `reach`
uniform vec3 eye;
uniform float reach, planeTolerance, lightMargin;
uniform int lightSamples, maxIterations;
uniform uint triangleCount;

#include "renderer/techniques/soft_shadows/pixel_class.h"
uint nodeCount = 0u, testedCount = 0u, reachedCount = 0u;
int iterations = 0;  // of all loops: llvmpipe leaves them silently once a shader has spent its share

// Light behind the surface's own plane is hidden, whether or not the body is closed.
void hideBehind(vec3 normal, vec3 p) {
  const HalfSpaceOfLight before = halfSpaceOfLight(normal, exactDot(normal, p), lightSize);
  HalfSpaceOfLight bounds[4];
  for (int i = 0; i < 4; ++i) bounds[i] = turned(before);
  addToMaskWithin(bounds, 0, kSamplesAlong);
}

// False if the driver would end the loop before its time.
bool gatherTriangles(vec3 p, uint own) {
  const uint end = nodes[0].skip;
  uint next = 0u;
  while (next < end) {
    if (iterations >= maxIterations) return false;
    ++nodeCount;
    ++iterations;
    const BvhNode node = nodes[next];
    if (!meetsPyramid(node, p, 0.5 * lightSize, planeTolerance)) {
      next = node.skip;
      continue;
    }
    const uint first = node.leaf >> 3, last = first + (node.leaf & 7u);
    iterations += int(last - first) * (kSamplesAlong + 1);
    for (uint i = first; i < last; ++i) {
      const BvhTriangle t = triangles[i];
      if (t.id == own) continue;
      ++testedCount;
      if (addTriangleToMask(t.a, t.b, t.c, p, lightSize, planeTolerance, lightMargin)) ++reachedCount;
    }
    if (last > first && allCovered()) return true;
    ++next;
  }
  return true;
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const vec4 receiver = texelFetch(receivers, pixel, 0);
  float visibility = 1.0;
  uint pixelClass = kNotReceiver;
  for (int i = 0; i < MASK_WORDS; ++i) mask[i] = ~lightShape[i];
  if (receiver.w >= 0.0) {
    vec3 p = receiver.xyz / reach;
    const uint own = texelFetch(triangleIds, pixel, 0).x;
    const vec4 plane = own < triangleCount ? planes[own] : vec4(0.0);
    if (plane.xyz != vec3(0.0)) {
      // Onto the surface's plane: the rounding of the position must not put a point beneath its neighbours.
      p -= plane.xyz * (dot(plane.xyz, p) - plane.w);
      hideBehind(dot(plane.xyz, eye - p) < 0.0 ? -plane.xyz : plane.xyz, p);
    }
    const bool complete = gatherTriangles(p, own);
    visibility = float(SAMPLES - samplesCovered()) / float(lightSamples);
    pixelClass = !complete           ? kCutShort
                 : visibility == 1.0 ? kLit
                 : visibility == 0.0 ? kUmbra
                                     : kProcessed;
    if (!complete) visibility = uintBitsToFloat(0x7fc00000u);  // no number rather than a wrong one
  }
  imageStore(outVisibility, pixel, vec4(visibility));
#ifdef COUNT
  imageStore(outCounts, pixel, uvec4(pixelClass, nodeCount, testedCount, reachedCount));
  const uint at = uint(pixel.y * sizePx.x + pixel.x) * uint(MASK_WORDS);
  for (int i = 0; i < MASK_WORDS; ++i) outMasks[at + uint(i)] = mask[i] & lightShape[i];
#endif
}
