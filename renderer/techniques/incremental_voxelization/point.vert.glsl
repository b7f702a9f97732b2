// SPDX-License-Identifier: BSD-3-Clause
// A point of the grid to its voxel (Gaitatzes 2012, listing 7.2).
#include "renderer/techniques/incremental_voxelization/voxel_textures.glsl"
#include "renderer/incremental_voxels/seen_samples.glsl"

layout(binding = kSeenNormalUnit) uniform sampler2D seenNormals;
layout(binding = kSeenLightUnit) uniform sampler2D seenLights;
uniform int seenView;
uniform bool weighted;
uniform ivec2 targetSizePx;

#if LAYOUT == LAYOUT_ATLAS
layout(location = 0) flat out vec3 pointNormal;
layout(location = 1) flat out vec3 pointLight;
#else
layout(location = 0) flat out vec3 cornerNormal;
layout(location = 1) flat out vec3 cornerLight;
layout(location = 2) flat out int cornerLayer;
#endif

void main() {
  SeenSample seen;
  gl_PointSize = 1.0;
  vec3 normal = vec3(0.0), light = vec3(0.0);
  int layer = -1;
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  if (sampleOf(seenView, gl_VertexID, seen)) {
    normal = texelFetch(seenNormals, seen.pixel, 0).xyz;
    const vec4 lit = texelFetch(seenLights, seen.pixel, 0);
    light = weighted ? lit.xyz * lit.w : lit.xyz;
    const ivec3 stored = storedVoxel(seen.voxel);
    layer = stored.z;
    const ivec2 texel = texelOf(stored, gridSize()).xy;
    // Row 0 of images is their top.
    gl_Position = vec4(vec2(2.0, -2.0) * (vec2(texel) + 0.5) / vec2(targetSizePx) + vec2(-1.0, 1.0), 0.5, 1.0);
  }
#if LAYOUT == LAYOUT_ATLAS
  pointNormal = normal;
  pointLight = light;
#else
  cornerNormal = normal;
  cornerLight = light;
  cornerLayer = layer;
#endif
}
