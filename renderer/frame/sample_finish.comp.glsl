// SPDX-License-Identifier: BSD-3-Clause
// Adds the centre's triangle to the samples of listed pixels that it covers whole: SampleRaster leaves it out until now.
// CLEAR: empties these pixels' samples for the next frame instead.
#include "renderer/frame/sample_list.glsl"
#include "renderer/frame/raster_triangle.glsl"

layout(std430, binding = kRasterDepthsBuffer) buffer Depths { uint depths[]; };
layout(std430, binding = kRasterIdsBuffer) buffer Ids { uint ids[]; };
layout(binding = kSampleRasterCentreIdsUnit) uniform usampler2D centreIds;
layout(binding = kSampleRasterReachUnit) uniform sampler2D reach;
layout(binding = kSampleRasterMarksImage, r32ui) uniform writeonly uimage2D marks;
uniform vec2 samplePlaces[SAMPLES];

void main() {
  const uint item = placeInList();
  if (item >= list.pixels) return;
  const int at = int(listed[item]);
  const ivec2 pixel = ivec2(at % sizePx.x, at / sizePx.x);
#ifdef CLEAR
  for (int i = 0; i < SAMPLES; ++i) {
    depths[at * SAMPLES + i] = 0u;
    ids[at * SAMPLES + i] = 0xffffffffu;
  }
  imageStore(marks, pixel, uvec4(0u));
#else
  if (!(texelFetch(reach, pixel, 0).x > 0.0)) return;
  const uint id = texelFetch(centreIds, pixel, 0).x;
  const uvec3 vertices = sceneTriangle(id);
  const vec3 a = clipPosition(vertices.x), b = clipPosition(vertices.y), c = clipPosition(vertices.z);
  for (int i = 0; i < SAMPLES; ++i) {
    float depth;
    if (!covers(a, b, c, vec2(pixel) + samplePlaces[i], depth)) continue;
    const int sampleAt = at * SAMPLES + i;
    const uint bits = floatBitsToUint(depth), other = depths[sampleAt];
    if (bits > other || (bits == other && id < ids[sampleAt])) {
      depths[sampleAt] = bits;
      ids[sampleAt] = id;
    }
  }
#endif
}
