// SPDX-License-Identifier: BSD-3-Clause
// Sorts the samples of each listed pixel by surface and appends a point for every surface but that of the pixel's own point.
// Samples are on the surface of a point if they see the same triangle, or lie near its plane and face much the same way.
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
shared uint groupPoints, groupDropped, groupComplex, firstPoint;

struct SurfacePoint {
  vec3 position, normal;
  uint id, source;
};

bool isReceiver(SeenPoint seen) {
  const vec3 p = (cameraToLight * vec4(seen.position, 1.0)).xyz, n = mat3(cameraToLight) * seen.normal;
  return p.z > 0.0 && dot(n, p) < 0.0;
}

SeenPoint seenAt(uint id, vec2 place) {
  const uvec3 vertices = sceneTriangle(id);
  const vec3 a = (anchorToCamera * vec4(scenePosition(vertices.x), 1.0)).xyz;
  const vec3 b = (anchorToCamera * vec4(scenePosition(vertices.y), 1.0)).xyz;
  const vec3 c = (anchorToCamera * vec4(scenePosition(vertices.z), 1.0)).xyz;
  return pointSeen(a, b, c, placeRay(place, rayScale, sizePx));
}

void main() {
  if (gl_LocalInvocationID.x == 0u) groupPoints = groupDropped = groupComplex = 0u;
  barrier();
  const uint item = placeInList();
  const bool inList = item < list.pixels;
  const int at = inList ? int(listed[item]) : 0;
  const ivec2 pixel = ivec2(at % sizePx.x, at / sizePx.x);
  SurfacePoint points[SAMPLES + 1];
  int pointCount = 0, ownPoints = 0;
  uint sources[SAMPLES];
  vec2 places[SAMPLES + 1];
  if (inList) {
    const uint centre = texelFetch(centreIds, pixel, 0).x;
    if (centre != kNoTriangle) {
      const SeenPoint seen = seenAt(centre, vec2(pixel) + 0.5);
      if (isReceiver(seen)) {
        points[0] = SurfacePoint(seen.position, seen.normal, centre, kSourceOwn);
        pointCount = ownPoints = 1;
      }
    }
    for (int i = 0; i < SAMPLES; ++i) {
      const uint id = samples[at * SAMPLES + i];
      sources[i] = kSourceNone;
      if (id == kNoTriangle) continue;
      // Most often the triangle is known already.
      bool found = false;
      for (int k = 0; k < pointCount && !found; ++k)
        if (points[k].id == id) {
          sources[i] = points[k].source;
          found = true;
        }
      if (found) continue;
      const vec2 place = vec2(pixel) + samplePlaces[i];
      const SeenPoint seen = seenAt(id, place);
      if (!isReceiver(seen)) continue;
      for (int k = 0; k < pointCount && !found; ++k)
        if (dot(points[k].normal, seen.normal) >= cosine &&
            abs(dot(points[k].normal, seen.position - points[k].position)) <= tolerance * seen.depth) {
          sources[i] = points[k].source;
          found = true;
        }
      if (found) continue;
      sources[i] = kSourcePoints + uint(pointCount - ownPoints);  // of this pixel's, for now
      points[pointCount] = SurfacePoint(seen.position, seen.normal, id, sources[i]);
      places[pointCount] = place;
      ++pointCount;
    }
  }
  const uint further = uint(pointCount - ownPoints);
  const uint inGroup = further > 0u ? atomicAdd(groupPoints, further) : 0u;
  bool complexPixel = false;
  for (int i = 1; inList && i < SAMPLES; ++i) complexPixel = complexPixel || sources[i] != sources[0];
  if (complexPixel) atomicAdd(groupComplex, 1u);
  barrier();
  if (gl_LocalInvocationID.x == 0u) firstPoint = groupPoints > 0u ? atomicAdd(counts.points, groupPoints) : 0u;
  barrier();
  const uint first = firstPoint + inGroup;
  if (inList) {
    for (uint k = 0u; k < further; ++k) {
      if (first + k >= capacity) break;
      const ivec2 point = furtherPoint(first + k);
      imageStore(outIds, point, uvec4(points[ownPoints + int(k)].id));
      imageStore(outPlaces, point, vec4(places[ownPoints + int(k)], 0.0, 0.0));
    }
    for (int i = 0; i < SAMPLES; ++i) {
      uint source = sources[i];
      if (source >= kSourcePoints) {
        source += first;
        if (source - kSourcePoints >= capacity) {
          // No room: whatever visibility the pixel has.
          source = ownPoints > 0 ? kSourceOwn : kSourceNone;
          atomicAdd(groupDropped, 1u);
        }
      }
      samples[at * SAMPLES + i] = source;
    }
  }
  barrier();
  if (gl_LocalInvocationID.x == 0u) {
    if (groupDropped > 0u) atomicAdd(counts.dropped, groupDropped);
    if (groupComplex > 0u) atomicAdd(counts.complexPixels, groupComplex);
  }
}
