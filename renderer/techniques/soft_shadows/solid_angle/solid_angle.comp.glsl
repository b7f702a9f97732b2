// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/shadow_lookup.glsl"
#define STRUCTURE_HSM
#include "renderer/techniques/soft_shadows/depth_bounds.glsl"

uniform int levels, refinements, taps, maxIterations;
uniform float lightRadius;
#if SAMPLING == SAMPLING_GAUSSIAN_POISSON
layout(std430, binding = kSolidAngleTapsBuffer) readonly buffer Taps { vec4 placesAndShares[]; };
#endif

// 1 - cos a of a ball's half-angle a, given sin a; the solid angle is 2 pi times this. A point within the ball sees half
// of all directions taken.
float capHeight(float sine) {
  const float squared = min(sine * sine, 1.0);
  return squared / (1.0 + sqrt(1.0 - squared));
}

// Where the cone from p around the light's ball meets the light's plane on one axis: offsets from the light's centre. The
// slopes m = dx / dz of rays that touch the ball solve (c_x - m c_z)^2 = R^2 (1 + m^2).
vec2 lightReach(float x, float z) {
  const float r2 = lightRadius * lightRadius, rest = z * z - r2;
  if (rest <= 0.0) return vec2(-1e18, 1e18);  // the ball reaches down to the point
  const float middle = -x * z, spread = lightRadius * sqrt(max(x * x + rest, 0.0));
  return x + z * vec2(middle - spread, middle + spread) / rest;
}

// Tangents [low.xy, high.xy] at which the cone meets the plane z: all that it meets farther away lie within.
vec4 coneSection(vec4 p, vec2 reachX, vec2 reachY, float z) {
  const float k = max(1.0 / z - 1.0 / p.z, 0.0);
  const vec2 centre = p.xy / p.z;
  return vec4(centre + k * vec2(reachX.x, reachY.x), centre + k * vec2(reachX.y, reachY.y));
}

Area texelsOf(vec4 section, out bool reachesOutside) {
  const vec2 limit = vec2(float(resolution)), low = floor(mapTexel(section.xy)), high = ceil(mapTexel(section.zw));
  reachesOutside = any(lessThan(low, vec2(0.0))) || any(greaterThan(high, limit));
  return Area(ivec2(clamp(low, vec2(0.0), limit)), ivec2(clamp(high, vec2(0.0), limit)));
}

float sumOfShares = 0.0;

// A patch of `size` tangents, around `tangent`, at the depth that the map has there.
void addPatch(vec2 tangent, vec2 size, float z, float depth, vec3 p, float lightCap) {
  ++fetchCount;
  ++examinedCount;
  if (!(z < depth)) return;
  ++occluderCount;
  const vec3 q = vec3(tangent * z, z), to = q - p, toLight = -p;
  const float distance = length(to), far = length(toLight);
  // Cone culling: a ball counts if its centre lies within the cone.
  const float sine = min(lightRadius / far, 1.0), cosine = dot(to, toLight) / (distance * far);
  if (!(cosine * cosine >= 1.0 - sine * sine && cosine > 0.0)) return;
  ++usedCount;
#if BALL == BALL_EQUAL_AREA
  const float radius = z * sqrt(size.x * size.y / 3.14159265358979);
#else
  const float radius = 0.5 * z * length(size);
#endif
  sumOfShares += capHeight(radius / distance) / lightCap;
}

float visibilityOf(vec4 p, ivec2 pixel) {
  const float depth = biasedDepth(p, 0);
  const vec2 reachX = lightReach(p.x, p.z), reachY = lightReach(p.y, p.z);
  float nearest = max(near, texelFetch(minimumMap, ivec2(0), levels - 1).x);
  pixelClass = kLit;
  fetchCount = 1u;
  if (nearest >= depth) return 1.0;
  Area area;
  vec4 section;
  for (int i = 0;; ++i) {
    section = coneSection(p, reachX, reachY, nearest);
    bool reachesOutside;
    area = texelsOf(section, reachesOutside);
    if (any(greaterThanEqual(area.low, area.high))) {
      if (reachesOutside) pixelClass = kOutside;
      return 1.0;
    }
    if (i >= refinements) break;
    const float found = depthRange(area, false).x;
    if (found >= depth) return 1.0;
    if (found <= nearest) break;
    nearest = found;
  }
  fetchCount += boundFetches;
  pixelClass = kProcessed;
  areaTexels = uint(area.high.x - area.low.x) * uint(area.high.y - area.low.y);
  const float lightCap = capHeight(lightRadius / length(p.xyz));
  const vec2 perTexel = tangentSize / float(resolution);
#if SAMPLING == SAMPLING_ALL
  if (float(area.high.x - area.low.x + 1) * float(area.high.y - area.low.y) > float(maxIterations)) {
    pixelClass = kCutShort;
    return uintBitsToFloat(0x7fc00000u);  // no number rather than a wrong one
  }
  for (int y = area.low.y; y < area.high.y; ++y)
    for (int x = area.low.x; x < area.high.x; ++x)
      addPatch(tangentLow + (vec2(x, y) + 0.5) * perTexel, perTexel, texelFetch(minimumMap, ivec2(x, y), 0).x, depth, p.xyz,
               lightCap);
#else
  // Only what the map shows is searched: the rest hides nothing that is known.
  const vec2 low = max(section.xy, tangentLow), size = min(section.zw, tangentLow + tangentSize) - low;
  for (int i = 0; i < taps * taps; ++i) {
#if SAMPLING == SAMPLING_REGULAR
    const vec2 place = (vec2(i % taps, i / taps) + 0.5) / float(taps), part = size / float(taps);
#else
    const vec2 place = placesAndShares[i].xy, part = size * sqrt(placesAndShares[i].z);
#endif
    const vec2 tangent = low + place * size;
    const ivec2 texel = clamp(ivec2(mapTexel(tangent)), ivec2(0), ivec2(resolution - 1));
    addPatch(tangent, part, texelFetch(minimumMap, texel, 0).x, depth, p.xyz, lightCap);
  }
#endif
  return 1.0 - min(sumOfShares, 1.0);
}
