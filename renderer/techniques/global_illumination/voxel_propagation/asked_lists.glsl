// SPDX-License-Identifier: BSD-3-Clause
// Lists of pixels whose light takes rays to find, and of these rays (seen_light.h). After gather_light.glsl.

layout(std430, binding = kAskedRaysBuffer) buffer AskedRays {
  AskedHeader asked;
  uint askedRays[];
};
layout(std430, binding = kAskedPixelsBuffer) buffer AskedPixels { uint askedPixels[]; };
layout(std430, binding = kSeenCornersBuffer) buffer SeenCorners { uvec2 seenCorners[]; };

uint pixelNumber(ivec2 pixel) { return uint(pixel.y * sizePx.x + pixel.x); }
ivec2 pixelOf(uint number) { return ivec2(number % uint(sizePx.x), number / uint(sizePx.x)); }
uint searchPlace(uint place) { return uint(sizePx.x * sizePx.y) + place; }

// Of an indirect dispatch.
uint listedPlace() {
  return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * uint(kAskedGroup) + gl_LocalInvocationIndex;
}

uint seenAtFace(uvec2 seen, int face) { return (face < 4 ? seen.x >> (8 * face) : seen.y >> (8 * (face - 4))) & 0xffu; }

// All faces; `doubtful`: corners of all faces about which only rays tell, as in seenCorners; `lacking`: whether a face has no light.
vec4 gathered(SurfacePoint point, uvec2 seen, out uvec2 doubtful, out bool lacking) {
  const vec3 at = toVoxels(point.position) - 0.5;
  vec4 result = vec4(0.0);
  doubtful = uvec2(0u);
  lacking = false;
  for (uint left = weightedFaces(point); left != 0u; left &= left - 1u) {
    const int face = findLSB(left);
    uint corners;
    const vec4 sum = lightAtFace(point, at, face, seenAtFace(seen, face), corners);
    if (face < 4)
      doubtful.x |= corners << (8 * face);
    else
      doubtful.y |= corners << (8 * (face - 4));
    if (sum.a > kLeastKnown)
      addFace(point, face, sum, result);
    else
      lacking = true;
  }
  return result;
}
