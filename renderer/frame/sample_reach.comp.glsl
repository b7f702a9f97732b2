// SPDX-License-Identifier: BSD-3-Clause
// How far behind the centre's triangle a pixel can be seen: the least near / distance of that triangle at the pixel's samples,
// or 0 where it does not cover them all. See sample_raster.h.
#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/raster_triangle.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kSampleRasterCentreIdsUnit) uniform usampler2D centreIds;
layout(binding = kSampleRasterReachImage, r32f) uniform writeonly image2D outReach;
uniform vec2 samplePlaces[SAMPLES];

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const uint id = texelFetch(centreIds, pixel, 0).x;
  float least = 0.0;
  if (id != 0xffffffffu) {
    const uvec3 vertices = sceneTriangle(id);
    const vec3 a = clipPosition(vertices.x), b = clipPosition(vertices.y), c = clipPosition(vertices.z);
    least = 1e38;
    for (int i = 0; i < SAMPLES; ++i) {
      float depth;
      if (!covers(a, b, c, vec2(pixel) + samplePlaces[i], depth)) least = 0.0;
      least = min(least, depth);
    }
  }
  imageStore(outReach, pixel, vec4(least));
}
