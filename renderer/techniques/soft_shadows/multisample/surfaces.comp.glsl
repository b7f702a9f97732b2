// SPDX-License-Identifier: BSD-3-Clause
// Sorts the samples of each listed pixel by surface and appends a point for every surface but that of the pixel's own point.
// Samples are on the surface of a point if they see the same triangle, or lie near its plane and face much the same way.
// An invocation for each place of a pixel, its centre and its samples (LANES of them).
#include "renderer/frame/sample_list.glsl"
#include "renderer/frame/scene_buffers.glsl"
#include "renderer/frame/seen_point.glsl"
#include "renderer/techniques/soft_shadows/multisample/multisample_bindings.h"
#include "renderer/techniques/soft_shadows/multisample/point_tiles.glsl"

layout(binding = kSurfaceCentreIdsUnit) uniform usampler2D centreIds;
layout(binding = kSurfacePointIdsImage, r32ui) uniform writeonly uimage2D outIds;
layout(binding = kSurfacePlacesImage, rg32f) uniform writeonly image2D outPlaces;
layout(std430, binding = kSurfaceCountsBuffer) buffer Counts { SurfaceCounts counts; };
layout(std430, binding = kSampleIdsBuffer) buffer SampleIds { uint samples[]; };  // triangles in, sources out

uniform vec2 rayScale;
uniform mat4 anchorToCamera, cameraToLight;
uniform vec2 samplePlaces[SAMPLES];
uniform float tolerance;  // distance from a point's plane, as a share of the distance along the view
uniform float cosine;     // least cosine between normals
uniform uint capacity;    // further points that there is room for

const uint kNoTriangle = 0xffffffffu;
const int kPlaces = SAMPLES + 1;  // of a pixel: its centre, then its samples

// What the places of the group's pixels see, place by place.
shared uint seenIds[kPlaces * kRasterGroup];        // kNoTriangle: no receiver
shared vec3 seenPositions[kPlaces * kRasterGroup], seenNormals[kPlaces * kRasterGroup];
shared uint groupPoints, groupDropped, groupComplex, firstPoint;

bool isReceiver(SeenPoint seen) {
  const vec3 p = (cameraToLight * vec4(seen.position, 1.0)).xyz, n = mat3(cameraToLight) * seen.normal;
  return p.z > 0.0 && dot(n, p) < 0.0;
}

vec2 placeIn(ivec2 pixel, int place) { return vec2(pixel) + (place == 0 ? vec2(0.5) : samplePlaces[place - 1]); }

// For one place of a pixel each.
void see(int at, ivec2 pixel) {
  const int place = int(gl_LocalInvocationID.x) / kRasterGroup;
  uint id = place == 0 ? texelFetch(centreIds, pixel, 0).x : samples[at * SAMPLES + place - 1];
  if (id != kNoTriangle) {
    const uvec3 vertices = sceneTriangle(id);
    const vec3 a = (anchorToCamera * vec4(scenePosition(vertices.x), 1.0)).xyz;
    const vec3 b = (anchorToCamera * vec4(scenePosition(vertices.y), 1.0)).xyz;
    const vec3 c = (anchorToCamera * vec4(scenePosition(vertices.z), 1.0)).xyz;
    const SeenPoint seen = pointSeen(a, b, c, placeRay(placeIn(pixel, place), rayScale, sizePx));
    seenPositions[gl_LocalInvocationID.x] = seen.position;
    seenNormals[gl_LocalInvocationID.x] = seen.normal;
    if (!isReceiver(seen)) id = kNoTriangle;
  }
  seenIds[gl_LocalInvocationID.x] = id;
}

bool onSurface(int sampleAt, int pointAt) {
  if (seenIds[sampleAt] == seenIds[pointAt]) return true;
  const vec3 normal = seenNormals[pointAt], position = seenPositions[sampleAt];
  return dot(normal, seenNormals[sampleAt]) >= cosine &&
         abs(dot(normal, position - seenPositions[pointAt])) <= tolerance * -position.z;
}

void main() {
  const int lane = int(gl_LocalInvocationID.x);
  if (lane == 0) groupPoints = groupDropped = groupComplex = 0u;
  const uint item = placeInList();
  const bool inList = item < list.pixels;
  const int at = inList ? int(listed[item]) : 0;
  const ivec2 pixel = ivec2(at % sizePx.x, at / sizePx.x);
  if (inList) see(at, pixel);
  barrier();

  // One invocation a pixel sorts.
  const bool sorts = inList && lane < kRasterGroup;
  int points[kPlaces];  // places that are points
  int pointCount = 0, ownPoints = 0;
  int pointOf[SAMPLES];  // number in `points`, or -1: none needed
  if (sorts) {
    if (seenIds[lane] != kNoTriangle) {
      points[0] = 0;
      pointCount = ownPoints = 1;
    }
    for (int i = 0; i < SAMPLES; ++i) {
      const int sampleAt = (i + 1) * kRasterGroup + lane;
      pointOf[i] = -1;
      if (seenIds[sampleAt] == kNoTriangle) continue;
      for (int k = 0; k < pointCount && pointOf[i] < 0; ++k)
        if (onSurface(sampleAt, points[k] * kRasterGroup + lane)) pointOf[i] = k;
      if (pointOf[i] >= 0) continue;
      pointOf[i] = pointCount;
      points[pointCount++] = i + 1;
    }
    for (int i = 1; i < SAMPLES; ++i)
      if (pointOf[i] != pointOf[0]) {
        atomicAdd(groupComplex, 1u);
        break;
      }
  }
  const uint further = uint(pointCount - ownPoints);
  const uint inGroup = further > 0u ? atomicAdd(groupPoints, further) : 0u;
  barrier();
  if (lane == 0) firstPoint = groupPoints > 0u ? atomicAdd(counts.points, groupPoints) : 0u;
  barrier();
  if (sorts) {
    const uint first = firstPoint + inGroup;
    for (int k = ownPoints; k < pointCount; ++k) {
      const uint i = first + uint(k - ownPoints);
      if (i >= capacity) break;
      imageStore(outIds, furtherPoint(i), uvec4(seenIds[points[k] * kRasterGroup + lane]));
      imageStore(outPlaces, furtherPoint(i), vec4(placeIn(pixel, points[k]), 0.0, 0.0));
    }
    for (int i = 0; i < SAMPLES; ++i) {
      uint source = kSourceNone;
      if (pointOf[i] >= ownPoints) {
        const uint point = first + uint(pointOf[i] - ownPoints);
        source = kSourcePoints + point;
        if (point >= capacity) {
          // No room: whatever visibility the pixel has.
          source = ownPoints > 0 ? kSourceOwn : kSourceNone;
          atomicAdd(groupDropped, 1u);
        }
      } else if (pointOf[i] >= 0) {
        source = kSourceOwn;
      }
      samples[at * SAMPLES + i] = source;
    }
  }
  barrier();
  if (lane == 0) {
    if (groupDropped > 0u) atomicAdd(counts.dropped, groupDropped);
    if (groupComplex > 0u) atomicAdd(counts.complexPixels, groupComplex);
  }
}
