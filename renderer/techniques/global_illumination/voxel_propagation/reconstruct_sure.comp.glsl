// SPDX-License-Identifier: BSD-3-Clause
// Light of pixels that surely see the voxels around them. The others get their direct light here and are listed, with the rays that tell
// which voxels they see: those of all pixels are traced together (reconstruct_rays.comp.glsl), as few of a group's pixels have any.
#include "renderer/techniques/global_illumination/indirect_point.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kIndirectPictureImage, rgba32f) uniform writeonly image2D picture;
#include "renderer/techniques/global_illumination/voxel_propagation/gather_light.glsl"
#include "renderer/techniques/global_illumination/voxel_propagation/asked_lists.glsl"

uniform uint mostRays;

shared uint rayCount, pixelCount, searchCount, firstRay, firstPixel, firstSearch;  // of the group; where it lists its own

void listRays(uint number, uvec2 doubtful, uint ray, uint count, uint place) {
  const bool fits = ray + count <= mostRays;
  for (uint i = ray; i < min(ray + count, mostRays); ++i) {
    const bool first = doubtful.x != 0u;
    const uint corner = uint(first ? findLSB(doubtful.x) : 32 + findLSB(doubtful.y));
    if (first)
      doubtful.x &= doubtful.x - 1u;
    else
      doubtful.y &= doubtful.y - 1u;
    askedRays[i] = fits ? number << kAskedCornerBits | corner : kNoRay;
  }
  seenCorners[number] = uvec2(0u);
  askedPixels[place] = fits ? number : number | kNotTraced;
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  const bool first = gl_LocalInvocationIndex == 0u, inside = all(lessThan(pixel, sizePx));
  if (first) rayCount = pixelCount = searchCount = 0u;
  barrier();
  vec3 colour = vec3(0.0);
  uvec2 doubtful = uvec2(0u);
  bool lacking = false;
  SurfacePoint point;
  if (inside && pixelSees(pixel, point)) {
    const vec3 albedo = reflectance(point);
    colour = directLight(point, albedo);
    if (withIndirect) {
      const vec4 result = gathered(point, uvec2(0u), doubtful, lacking);
      if (doubtful == uvec2(0u) && !lacking) colour += reflectedLight(result, albedo);
    }
    colour = unlessCutShort(colour);
  }
  if (inside) imageStore(picture, pixel, vec4(colour, 1.0));
  const uint count = uint(bitCount(doubtful.x) + bitCount(doubtful.y));
  uint ray = 0u, place = 0u;
  if (count > 0u) {
    ray = atomicAdd(rayCount, count);
    place = atomicAdd(pixelCount, 1u);
  } else if (lacking) {
    place = atomicAdd(searchCount, 1u);
  }
  barrier();
  if (first) {
    if (pixelCount > 0u) {
      firstRay = atomicAdd(asked.rays.count, rayCount);
      firstPixel = atomicAdd(asked.pixels.count, pixelCount);
    }
    if (searchCount > 0u) firstSearch = atomicAdd(asked.searches.count, searchCount);
  }
  barrier();
  if (count > 0u) {
    listRays(pixelNumber(pixel), doubtful, firstRay + ray, count, firstPixel + place);
  } else if (lacking) {
    seenCorners[pixelNumber(pixel)] = uvec2(0u);
    askedPixels[searchPlace(firstSearch + place)] = pixelNumber(pixel);
  }
}
