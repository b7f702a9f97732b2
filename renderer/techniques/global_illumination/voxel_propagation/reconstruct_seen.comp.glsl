// SPDX-License-Identifier: BSD-3-Clause
// Light of the listed pixels from the voxels around that they see; those that see none at some face are listed to search farther.
#include "renderer/techniques/global_illumination/indirect_point.glsl"

layout(local_size_x = kAskedGroup) in;
layout(binding = kIndirectPictureImage, rgba32f) uniform image2D picture;
#include "renderer/techniques/global_illumination/voxel_propagation/gather_light.glsl"
#include "renderer/techniques/global_illumination/voxel_propagation/asked_lists.glsl"

shared uint searchCount, firstSearch;

void main() {
  const uint place = listedPlace();
  if (gl_LocalInvocationIndex == 0u) searchCount = 0u;
  barrier();
  bool searches = false;
  uint entry = 0u;
  if (place < asked.pixels.listed) {
    entry = askedPixels[place];
    searches = (entry & kNotTraced) != 0u;
    SurfacePoint point;
    const ivec2 pixel = pixelOf(entry);
    if (!searches && pixelSees(pixel, point)) {
      uvec2 doubtful;
      const uvec2 seen = seenCorners[entry];
      const vec4 result = gathered(point, seen, doubtful, searches);
      rayCutShort = (seen.y & kSeenCutShort) != 0u;
      if (!searches || rayCutShort) {
        const vec3 colour = imageLoad(picture, pixel).rgb + reflectedLight(result, reflectance(point));
        imageStore(picture, pixel, vec4(unlessCutShort(colour), 1.0));
        searches = false;
      }
    }
  }
  uint own = 0u;
  if (searches) own = atomicAdd(searchCount, 1u);
  barrier();
  if (gl_LocalInvocationIndex == 0u && searchCount > 0u) firstSearch = atomicAdd(asked.searches.count, searchCount);
  barrier();
  if (searches) askedPixels[searchPlace(firstSearch + own)] = entry;
}
