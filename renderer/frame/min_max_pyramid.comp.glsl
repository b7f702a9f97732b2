// SPDX-License-Identifier: BSD-3-Clause
// Several levels of the min/max pyramid from one source level: each invocation reduces 2 x 2 texels, then each group its tile.
#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/shadow_depth.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
#ifdef FROM_DEPTH
layout(binding = kPyramidDepthMapUnit) uniform sampler2D depthMap;
layout(binding = kPyramidBaseImage, r32f) uniform writeonly image2D outBase;
#else
layout(binding = kPyramidMinimumMapUnit) uniform sampler2D minimumMap;
layout(binding = kPyramidMaximumMapUnit) uniform sampler2D maximumMap;
uniform int sourceLevel;
#endif
layout(binding = kPyramidMinimum1Image, r32f) uniform writeonly image2D outMinimum1;
layout(binding = kPyramidMinimum2Image, r32f) uniform writeonly image2D outMinimum2;
layout(binding = kPyramidMinimum3Image, r32f) uniform writeonly image2D outMinimum3;
layout(binding = kPyramidMaximum1Image, r32f) uniform writeonly image2D outMaximum1;
layout(binding = kPyramidMaximum2Image, r32f) uniform writeonly image2D outMaximum2;
layout(binding = kPyramidMaximum3Image, r32f) uniform writeonly image2D outMaximum3;
#ifdef FROM_DEPTH
const int kMostLevels = kPyramidFirstLevels;
#else
const int kMostLevels = kPyramidNextLevels;
layout(binding = kPyramidMinimum4Image, r32f) uniform writeonly image2D outMinimum4;
layout(binding = kPyramidMaximum4Image, r32f) uniform writeonly image2D outMaximum4;
#endif
uniform float near;
uniform int sourceSize, levelsMade;

shared vec2 tile[8][8];

vec2 combine(vec2 a, vec2 b) { return vec2(min(a.x, b.x), max(a.y, b.y)); }

#ifdef FROM_DEPTH
// Depths of the group's tile: neighbouring invocations read and store neighbouring texels.
shared float depths[2 * kGroupSide][2 * kGroupSide];

void loadTile() {
  for (int i = 0; i < 4; ++i) {
    const ivec2 inTile = ivec2(gl_LocalInvocationID.xy) + kGroupSide * ivec2(i & 1, i >> 1);
    const ivec2 texel = ivec2(gl_WorkGroupID.xy) * 2 * kGroupSide + inTile;
    // A 1-texel map is its own only level: clamping keeps reads inside.
    const float z = linearDepth(texelFetch(depthMap, min(texel, ivec2(sourceSize - 1)), 0).x, near);
    if (all(lessThan(texel, ivec2(sourceSize)))) imageStore(outBase, texel, vec4(z));
    depths[inTile.y][inTile.x] = z;
  }
  barrier();
}

vec2 sourceRange(ivec2 texel) {
  const ivec2 inTile = texel - ivec2(gl_WorkGroupID.xy) * 2 * kGroupSide;
  return vec2(depths[inTile.y][inTile.x]);
}
#else
vec2 sourceRange(ivec2 texel) {
  texel = min(texel, ivec2(sourceSize - 1));
  return vec2(texelFetch(minimumMap, texel, sourceLevel).x, texelFetch(maximumMap, texel, sourceLevel - 1).x);
}
#endif

void main() {
#ifdef FROM_DEPTH
  loadTile();
#endif
  const ivec2 at = ivec2(gl_GlobalInvocationID.xy), local = ivec2(gl_LocalInvocationID.xy);
  const ivec2 size1 = ivec2(max(sourceSize / 2, 1));
  const bool inside = all(lessThan(at, size1));
  vec2 range = vec2(kEmptyDepth, -kEmptyDepth);
  if (inside) {
    range = combine(combine(sourceRange(2 * at), sourceRange(2 * at + ivec2(1, 0))),
                    combine(sourceRange(2 * at + ivec2(0, 1)), sourceRange(2 * at + ivec2(1, 1))));
    if (levelsMade >= 1) {
      imageStore(outMinimum1, at, vec4(range.x));
      imageStore(outMaximum1, at, vec4(range.y));
    }
  }
  tile[local.y][local.x] = range;
  for (int level = 2; level <= kMostLevels; ++level) {
    barrier();
    const int step = 1 << (level - 1), half_ = step >> 1;
    const bool reduces = all(equal(local & (step - 1), ivec2(0)));
    if (reduces)
      range = combine(combine(tile[local.y][local.x], tile[local.y][local.x + half_]),
                      combine(tile[local.y + half_][local.x], tile[local.y + half_][local.x + half_]));
    barrier();
    if (reduces) {
      tile[local.y][local.x] = range;
      if (inside && level <= levelsMade) {
        if (level == 2) {
          imageStore(outMinimum2, at >> 1, vec4(range.x));
          imageStore(outMaximum2, at >> 1, vec4(range.y));
        } else if (level == 3) {
          imageStore(outMinimum3, at >> 2, vec4(range.x));
          imageStore(outMaximum3, at >> 2, vec4(range.y));
        }
#ifndef FROM_DEPTH
        else {
          imageStore(outMinimum4, at >> 3, vec4(range.x));
          imageStore(outMaximum4, at >> 3, vec4(range.y));
        }
#endif
      }
    }
  }
}
