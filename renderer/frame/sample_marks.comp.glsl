// SPDX-License-Identifier: BSD-3-Clause
// Lists the pixels of which one of the eight around sees another surface behind its centre: another distance than that of the
// pixel's own plane, another orientation, none at all, or one that light cannot reach from the front where it can here. See
// sample_raster.h. Their reach is that of sample_reach.comp.glsl; a group is a tile.
// CENTRES: what their samples see follows at once, from the triangles behind the nine centres. See centre_samples.h.
#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/raster_triangle.glsl"
#include "renderer/frame/seen_point.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kSampleRasterCentreIdsUnit) uniform usampler2D centreIds;
layout(binding = kSampleRasterMarksImage, r32ui) uniform writeonly uimage2D marks;
#ifdef CENTRES
layout(std430, binding = kRasterIdsBuffer) writeonly buffer Ids { uint ids[]; };
#else
layout(binding = kSampleRasterReachImage, r32f) uniform writeonly image2D outReach;
layout(binding = kSampleRasterTilesImage, r32ui) uniform writeonly uimage2D outTiles;
#endif
layout(std430, binding = kSampleRasterListBuffer) buffer List {
  SampleListHeader list;
  uint listed[];  // pixels, by row
};
uniform vec2 samplePlaces[SAMPLES];
uniform vec2 rayScale;
uniform mat4 anchorToCamera, cameraToLight;
uniform float tolerance;  // distance from a point's plane, as a share of the distance along the view
uniform float cosine;     // least cosine between normals

const uint kNothing = 0xffffffffu, kOffPicture = 0xfffffffeu;
const int kSide = kGroupSide + 2, kPoints = kSide * kSide;  // of a tile with a rim of one pixel
shared uint seenIds[kPoints];
shared vec3 seenPositions[kPoints], seenNormals[kPoints];
shared bool seenLit[kPoints];  // its front is turned to the light
#ifdef CENTRES
shared vec3 seenCorners[3][kPoints];  // of the triangle, in clip space
#endif
shared uint groupListed, firstListed;

void see(int i) {
  const ivec2 pixel = ivec2(gl_WorkGroupID.xy) * kGroupSide + ivec2(i % kSide, i / kSide) - 1;
  seenIds[i] = kOffPicture;
  if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, sizePx))) return;
  const uint id = texelFetch(centreIds, pixel, 0).x;
  seenIds[i] = id;
  if (id == kNothing) return;
  const uvec3 vertices = sceneTriangle(id);
  const SeenPoint seen = pointSeen((anchorToCamera * vec4(scenePosition(vertices.x), 1.0)).xyz,
                                   (anchorToCamera * vec4(scenePosition(vertices.y), 1.0)).xyz,
                                   (anchorToCamera * vec4(scenePosition(vertices.z), 1.0)).xyz,
                                   pixelRay(pixel, rayScale, sizePx));
  seenPositions[i] = seen.position;
  seenNormals[i] = seen.normal;
  const vec3 p = (cameraToLight * vec4(seen.position, 1.0)).xyz;
  seenLit[i] = p.z > 0.0 && dot(mat3(cameraToLight) * seen.normal, p) < 0.0;
#ifdef CENTRES
  for (int corner = 0; corner < 3; ++corner) seenCorners[corner][i] = clipPosition(vertices[corner]);
#endif
}

bool isOther(int own, int other) {
  const uint id = seenIds[own], there = seenIds[other];
  if (there == kOffPicture || id == there) return false;
  if (id == kNothing || there == kNothing) return true;
  const vec3 normal = seenNormals[own], position = seenPositions[other];
  return seenLit[own] != seenLit[other] || dot(normal, seenNormals[other]) < cosine ||
         abs(dot(normal, position - seenPositions[own])) > tolerance * -position.z;
}

#ifdef CENTRES
// Triangle behind one of the nine centres around a pixel that a place in it sees. Where none of them covers the place: nothing if one of the
// centres sees nothing, otherwise what the pixel's own centre sees.
uint seenFrom(int own, vec2 place) {
  float nearest = 0.0;
  uint id = kNothing;
  bool covered = false, nothing = false;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) {
      const int other = own + y * kSide + x;
      const uint there = seenIds[other];
      if (there == kOffPicture) continue;
      if (there == kNothing) {
        nothing = true;
        continue;
      }
      float depth;
      if (!covers(seenCorners[0][other], seenCorners[1][other], seenCorners[2][other], place, depth)) continue;
      // As in the rasteriser.
      if (depth > nearest || (depth == nearest && there < id)) {
        nearest = depth;
        id = there;
      }
      covered = true;
    }
  return covered || nothing ? id : seenIds[own];
}
#else
// Least near / distance of a triangle at the pixel's samples; 0: it does not cover them all.
float reachOf(uint id, ivec2 pixel) {
  if (id == kNothing) return 0.0;
  const uvec3 vertices = sceneTriangle(id);
  const vec3 a = clipPosition(vertices.x), b = clipPosition(vertices.y), c = clipPosition(vertices.z);
  float least = 1e38;
  for (int i = 0; i < SAMPLES; ++i) {
    float depth;
    if (!covers(a, b, c, vec2(pixel) + samplePlaces[i], depth)) return 0.0;
    least = min(least, depth);
  }
  return least;
}
#endif

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), lane = ivec2(gl_LocalInvocationID.xy);
  for (int i = int(gl_LocalInvocationIndex); i < kPoints; i += kGroupSide * kGroupSide) see(i);
  if (gl_LocalInvocationIndex == 0u) groupListed = 0u;
  barrier();
  const int own = (lane.y + 1) * kSide + lane.x + 1;
  bool lists = false;
  if (seenIds[own] != kOffPicture)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) lists = lists || isOther(own, own + y * kSide + x);
  const uint slot = lists ? atomicAdd(groupListed, 1u) : 0u;
  barrier();
  if (gl_LocalInvocationIndex == 0u) {
    firstListed = groupListed > 0u ? atomicAdd(list.pixels, groupListed) : 0u;
#ifndef CENTRES
    imageStore(outTiles, ivec2(gl_WorkGroupID.xy), uvec4(groupListed));
#endif
  }
  barrier();
#ifdef CENTRES
  if (seenIds[own] != kOffPicture) imageStore(marks, pixel, uvec4(lists ? 1u : 0u));
  if (!lists) return;
  for (int i = 0; i < SAMPLES; ++i)
    ids[(pixel.y * sizePx.x + pixel.x) * SAMPLES + i] = seenFrom(own, vec2(pixel) + samplePlaces[i]);
#else
  if (!lists) return;
  imageStore(marks, pixel, uvec4(1u));
  imageStore(outReach, pixel, vec4(reachOf(seenIds[own], pixel)));
#endif
  listed[firstListed + slot] = uint(pixel.y * sizePx.x + pixel.x);
}
