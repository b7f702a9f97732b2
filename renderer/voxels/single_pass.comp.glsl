// SPDX-License-Identifier: BSD-3-Clause
// Clean-up and injection in one (Gaitatzes 2012, section 7.4.3): a voxel whose middle lies within the bias of the surface that a
// view sees there is filled with what that pixel shows; one before it is emptied; one behind it stays. A brick a group, a row of
// 32 voxels half of its invocations.
#include "renderer/frame/frame_bindings.h"
#include "renderer/voxels/disproof.glsl"
#ifdef ATTRIBUTES
#include "renderer/voxels/seen_surface.glsl"
#endif

layout(local_size_x = kBrickWords) in;
layout(binding = kSampledBitsImage, r32ui) uniform uimage2DArray bitsImage;
layout(std430, binding = kSampleStateBuffer) buffer State {
  SampleCounts sampleCounts[2];
  uint sampleList[];
};
uniform int turn, brickCount, brickCountX, brickCountY;
#ifdef ATTRIBUTES
layout(binding = kSampledNormalImage, rgba16f) uniform writeonly image2DArray normalImage;
layout(binding = kSampledAlbedoImage, rgba16f) uniform writeonly image2DArray albedoImage;
layout(binding = kSampledLightImage, rgba16f) uniform writeonly image2DArray lightImage;
#endif

shared uint words[kBrickWords];
shared uint keptCount, clearedCount, addedCount;

#ifdef ATTRIBUTES
void update(ivec3 voxel, int view) {
  const vec2 place = viewPlace(view, toView(view, vec3(voxel) + 0.5));
  const ivec2 pixel = ivec2(place);
  const vec3 at = (voxelsFromView[view] * vec4(viewNear[view] / depthAt(view, pixel) * viewRay(view, pixel), 1.0)).xyz;
  const SeenSurface surface = surfaceOf(view, pixel, at);
  imageStore(normalImage, voxel, vec4(surface.normal, 1.0));
  imageStore(albedoImage, voxel, vec4(surface.albedo, 1.0));
  imageStore(lightImage, voxel, vec4(surface.light, 1.0));
}
#endif

// What a voxel becomes.
bool isFilled(ivec3 voxel, bool before) {
  int by = -1;
  for (int view = 0; view < USED_VIEWS; ++view) {
    const int found = disproofByView(view, voxel);
    if (found == kDisproofCleared) {
#ifdef ATTRIBUTES
      if (before) {
        imageStore(normalImage, voxel, vec4(0.0));
        imageStore(albedoImage, voxel, vec4(0.0));
        imageStore(lightImage, voxel, vec4(0.0));
      }
#endif
      return false;
    }
    if (found == kDisproofSurface && by < 0) by = view;
  }
#ifdef ATTRIBUTES
  if (by >= 0) update(voxel, by);
#endif
  return before || by >= 0;
}

void main() {
  const uint lane = gl_LocalInvocationIndex;
  const int brick = int(gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y);
  if (lane == 0u) {
    keptCount = clearedCount = addedCount = 0u;
    if (brick == 0) sampleCounts[1 - turn] = SampleCounts(0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u);
  }
  barrier();
  if (brick >= brickCount) return;
  const ivec3 first = ivec3(1, kBrickSide, kBrickSide) *
                      ivec3(brick % brickCountX, brick / brickCountX % brickCountY, brick / (brickCountX * brickCountY));
  const ivec3 texel = first + ivec3(0, lane % uint(kBrickSide), lane / uint(kBrickSide));
  const bool isIn = texel.y < gridSizeY && texel.z < gridSizeZ;
  const uint word = isIn ? imageLoad(bitsImage, texel).x : 0u;
  words[lane] = word;
  barrier();
  for (uint i = lane; i < 32u * uint(kBrickWords); i += uint(kBrickWords)) {
    const uint at = i / 32u, bit = i % 32u;
    const ivec3 voxel = ivec3(32 * first.x + int(bit), first.yz + ivec2(at % uint(kBrickSide), at / uint(kBrickSide)));
    if (!isInGrid(voxel)) continue;
    const bool before = (words[at] >> bit & 1u) != 0u, after = isFilled(voxel, before);
    if (before && after) atomicAdd(keptCount, 1u);
    if (before && !after) atomicAnd(words[at], ~(1u << bit));
    if (!before && after) atomicOr(words[at], 1u << bit);
    if (before && !after) atomicAdd(clearedCount, 1u);
    if (!before && after) atomicAdd(addedCount, 1u);
  }
  barrier();
  if (words[lane] != word) imageStore(bitsImage, texel, uvec4(words[lane]));
  if (lane == 0u) {
    if (keptCount > 0u) atomicAdd(sampleCounts[turn].kept, keptCount);
    if (clearedCount > 0u) atomicAdd(sampleCounts[turn].cleared, clearedCount);
    if (addedCount > 0u) atomicAdd(sampleCounts[turn].added, addedCount);
    atomicAdd(sampleCounts[turn].tested, 1u);
  }
}
