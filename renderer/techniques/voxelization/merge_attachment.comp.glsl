// SPDX-License-Identifier: BSD-3-Clause
// An attachment of three volumes, whose layers lie across an axis each, as one, in occupied voxels: the largest, or the
// mean of fragments. A volume without a fragment in a voxel has no part in it.
#include "renderer/techniques/voxelization/voxelization_bindings.h"
#include "renderer/voxels/volume_words.glsl"

layout(binding = kAxisVolumeXUnit) uniform sampler2DArray alongX;
layout(binding = kAxisVolumeYUnit) uniform sampler2DArray alongY;
layout(binding = kAxisVolumeZUnit) uniform sampler2DArray alongZ;
layout(binding = kAxisNormalXUnit) uniform sampler2DArray normalX;
layout(binding = kAxisNormalYUnit) uniform sampler2DArray normalY;
layout(binding = kAxisNormalZUnit) uniform sampler2DArray normalZ;
layout(binding = kMergedAttachmentImage, VOLUME_FORMAT) uniform writeonly image2DArray attachmentImage;
uniform float largest;  // of what was scaled to 0 to 1

vec4 merged(ivec3 v) {
  const vec4 x = texelFetch(alongX, v.yzx, 0), y = texelFetch(alongY, v.zxy, 0), z = texelFetch(alongZ, v, 0);
#if defined(MEAN_ALPHA)  // alpha counts
  const vec4 sum = x + y + z;
  return vec4(sum.xyz / max(sum.w, 1.0), min(sum.w, 1.0));
#elif defined(MEAN_NORMAL)  // the normals' alpha counts
  const float count = texelFetch(normalX, v.yzx, 0).w + texelFetch(normalY, v.zxy, 0).w + texelFetch(normalZ, v, 0).w;
  return (x + y + z) / max(count, 1.0);
#else
  const vec4 most = max(x, max(y, z));
#if defined(SIGNED_XYZ)
  return vec4((2.0 * most.xyz - 1.0) * largest, most.w);
#elif defined(SIGNED)
  return (2.0 * most - 1.0) * largest;
#else
  return most;
#endif
#endif
}

void main() {
  const ivec3 texel = wordOf(gl_LocalInvocationIndex);
  if (!isWord(texel)) return;
  for (uint word = texelFetch(volumeBits, texel, 0).x; word != 0u; word &= word - 1u) {
    const ivec3 voxel = ivec3(32 * texel.x + findLSB(word), texel.yz);
    imageStore(attachmentImage, voxel, merged(voxel));
  }
}
