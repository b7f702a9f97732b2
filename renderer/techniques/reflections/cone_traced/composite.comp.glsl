// SPDX-License-Identifier: BSD-3-Clause
// Light of each pixel's cone: of the triangles that may meet its tile those that fill a share of it, the nearest ones first,
// until it is full (Roger 2008, sections 5.2.3 and 5.2.4). See cone_traced.cpp.
//   COUNT      counts for each pixel, and looks at every triangle
//   TABLE      contribution by the table of overlaps and places
//   MASKED     what is hidden within the cone by a mask of its area
//   FILTERED   patterns as wide as the overlap
//   PEEL       writes all that fill a share of a cone, for peeling, in place of the nearest
//   UNFILLED, RESCALED, ENVIRONMENT   what fills the rest
//   RESUMED    a dispatch looks at a part of each list, and the last one composes: a software renderer limits the loop
//              rounds of an invocation
#include "renderer/techniques/reflections/cone_traced/cone_traced_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kConeOriginsUnit) uniform sampler2D coneOrigins;
layout(binding = kConeDirectionsUnit) uniform sampler2D coneDirections;
layout(binding = kConeIdsUnit) uniform usampler2D triangleIds;
layout(binding = kConeShapesUnit) uniform sampler2D coneShapes;
layout(binding = kConeImage, rgba32f) uniform writeonly image2D outImage;
#ifdef COUNT
layout(binding = kConeCountsImage, rgba32f) uniform writeonly image2D outCounts;
#endif
layout(std430, binding = kConeSpheresBuffer) readonly buffer Spheres { vec4 spheres[]; };
layout(std430, binding = kConeListsBuffer) readonly buffer Lists { uint lists[]; };

uniform ivec2 sizePx;
uniform uint tileCount, triangleCount, leafLevel;
#ifdef RESUMED
layout(binding = kConeStateImage, rg32ui) uniform uimage2DArray searchState;
uniform uint firstEntry;  // of each list that this dispatch looks at: kConeEntriesPerRound, then the others' turn
uniform bool finishing;   // no other dispatch comes
#endif
uniform float leastShare, farRadius;
uniform bool flatShading;
#ifdef FILTERED
#define PATTERN_WIDTH
#endif
#include "renderer/frame/ray_origin.glsl"
#include "renderer/frame/shading.glsl"
#include "renderer/techniques/reflections/cone_traced/beam.glsl"
#include "renderer/techniques/reflections/cone_traced/contribution.glsl"
#include "renderer/techniques/reflections/cone_traced/nearest_triangles.glsl"

#ifdef LIT
float sunShare(ivec2 pixel, SeenPoint seen) { return 1.0; }
#endif
#include "renderer/techniques/reflections/cone_traced/fill.glsl"
#ifdef PEEL
#include "renderer/techniques/reflections/cone_traced/peel_items.glsl"
#endif

float needed = 3.0e38;  // distance of what fills the cone alone
float farthest = 3.0e38;
int met = 0;
float metShare = 0.0;

vec3 colourAt(Beam beam, BeamShare found, uint triangle) {
  const uvec3 vertices = sceneTriangle(triangle);
  const vec3 a = scenePosition(vertices.x), b = scenePosition(vertices.y), c = scenePosition(vertices.z);
  const vec3 at = beamPoint(beam, found.middle, found.along);
  SurfacePoint point = surfaceHit(triangle, barycentrics(a, b, c, at), beamDirection(beam, found.middle));
  if (flatShading) point.normal = point.flatNormal;
#ifdef FILTERED
  const float radius = beam.radius + beam.growth * found.along;
  const float cosine = max(dot(point.flatNormal, point.view), 1e-3);
  patternWidth = radius * sqrt(3.14159265 * found.share * beam.share / cosine);
  patternNormal = point.flatNormal;
#endif
  return pointColour(point, 1.0);
}

// A triangle that may meet the cone: keeps it if it does.
void consider(Beam beam, uint triangle, uint leaves, float wide) {
  if (triangle == leaves) return;
  const vec4 sphere = spheres[triangle];
  if (!(sphere.w >= 0.0)) return;
  const vec3 centre = inBeam(beam, sphere.xyz);
  const float first = centre.z - sphere.w;
  // The cone's rim along the side of the sphere, rounded up; cone_sphere.glsl has the same test for nodes.
  const float slant = sqrt(1.0 + beam.growth * beam.growth);
  if (length(centre.xy) - beam.radius - beam.growth * centre.z > sphere.w * slant * 1.0001 + 1e-5 * (abs(centre.z) + length(centre.xy)))
    return;
  if (centre.z + sphere.w < 0.0) return;
#if !defined(COUNT) && !defined(PEEL)
  const float least = first - 1e-5 * abs(centre.z);
  if (least > needed || (keptCount == LAYERS && least > uintBitsToFloat(kept[0].x))) return;
#endif
  const uvec3 vertices = sceneTriangle(triangle);
  const BeamShare found = shareOf(beam, scenePosition(vertices.x), scenePosition(vertices.y), scenePosition(vertices.z),
                                  originTolerance);
  if (!(found.share > 0.0) || found.along > farthest) return;
  ++met;
  metShare += found.share;
  if (found.share < leastShare) return;
#ifdef PEEL
  addItem(ivec2(gl_GlobalInvocationID.xy), found.along, contribution(beam, found, wide), colourAt(beam, found, triangle));
#else
  if (found.share > 0.99999) needed = min(needed, found.along);
  keep(uvec2(floatBitsToUint(found.along), triangle));
#endif
}

#ifdef RESUMED
void loadSearch(ivec2 pixel) {
  const uvec2 state = imageLoad(searchState, ivec3(pixel, 0)).xy, counted = imageLoad(searchState, ivec3(pixel, 1)).xy;
  keptCount = int(state.x);
  needed = uintBitsToFloat(state.y);
  met = int(counted.x);
  metShare = uintBitsToFloat(counted.y);
  for (int i = 0; i < keptCount; ++i) kept[i] = imageLoad(searchState, ivec3(pixel, 2 + i)).xy;
}

void storeSearch(ivec2 pixel) {
  imageStore(searchState, ivec3(pixel, 0), uvec4(keptCount, floatBitsToUint(needed), 0u, 0u));
  imageStore(searchState, ivec3(pixel, 1), uvec4(met, floatBitsToUint(metShare), 0u, 0u));
  for (int i = 0; i < keptCount; ++i) imageStore(searchState, ivec3(pixel, 2 + i), uvec4(kept[i], 0u, 0u));
}
#endif

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const vec4 origin = texelFetch(coneOrigins, pixel, 0);
  vec4 result = vec4(0.0), counts = vec4(-1.0, 0.0, 0.0, 0.0);
  if (origin.w > 0.0) {
    const uint id = texelFetch(triangleIds, pixel, 0).x;
    const vec4 direction = texelFetch(coneDirections, pixel, 0);
    const uvec3 own = sceneTriangle(id);
    vec3 normal = planeNormal(scenePosition(own.x), scenePosition(own.y), scenePosition(own.z));
    if (dot(normal, direction.xyz) < 0.0) normal = -normal;
    if (isnan(dot(normal, normal)) || isinf(dot(normal, normal))) normal = direction.xyz;
    const Beam beam = beamOf(origin, direction, normal);
    if (farRadius > 0.0) farthest = max(farRadius - beam.radius, 0.0) / max(beam.growth, 1e-30);
    const ivec2 at = pixel >> int(leafLevel);
    const uint tile = uint(at.y * ((sizePx.x + (1 << leafLevel) - 1) >> leafLevel) + at.x);
    const uint first = lists[2u * tile], listed = lists[2u * tile + 1u];
    uint begin = 0u, end = listed == kConeUnlisted ? triangleCount : listed;
    const float wide = texelFetch(coneShapes, pixel, 0).x;
    keepNone();
#ifdef RESUMED
    if (firstEntry > 0u && firstEntry >= end && !finishing) return;
    if (firstEntry > 0u) loadSearch(pixel);
    begin = firstEntry;
    end = min(end, firstEntry + kConeEntriesPerRound);
#endif
    for (uint i = begin; i < end; ++i)
      consider(beam, listed == kConeUnlisted ? i : lists[2u * tileCount + first + i], id, wide);
#ifdef RESUMED
    if (!finishing) {
      storeSearch(pixel);
      return;
    }
#endif
    sortKept();
    vec3 sum = vec3(0.0);
    float covered = 0.0, keptShare = 0.0;
    for (int i = 0; i < keptCount; ++i) {
      const uint triangle = kept[i].y;
      const uvec3 vertices = sceneTriangle(triangle);
      const BeamShare found = shareOf(beam, scenePosition(vertices.x), scenePosition(vertices.y),
                                      scenePosition(vertices.z), originTolerance);
      keptShare += found.share;
      const float weight = unhidden(contribution(beam, found, wide), covered);
      if (!(weight > 0.0)) continue;
      sum += weight * colourAt(beam, found, triangle);
      covered += weight;
#ifndef COUNT
      if (covered >= 0.99999) break;
#endif
    }
    result = filled(sum, covered, direction.xyz, direction.w);
    counts = vec4(float(met), float(keptCount), max(metShare - keptShare, 0.0), covered);
  }
  imageStore(outImage, pixel, result);
#ifdef COUNT
  imageStore(outCounts, pixel, counts);
#endif
}
