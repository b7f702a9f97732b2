// SPDX-License-Identifier: BSD-3-Clause
// Share of the hemisphere over each pixel's point that the depths around the pixel leave open, from a kernel of K x K
// places or of K along each of two axes. See screen_space.cpp.
#include "renderer/techniques/ambient_occlusion/occlusion_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kOcclusionDepthUnit) uniform sampler2D depths;    // along the view; 0: background
layout(binding = kOcclusionNormalUnit) uniform sampler2D normals;  // relative to the anchor
layout(binding = kOcclusionPackedImage, rgba32f) uniform writeonly image2D outPacked;
#ifdef COUNT
layout(std430, binding = kOcclusionCountsBuffer) buffer Counts { uint fetchCounts[]; };
#endif

uniform ivec2 sizePx;
uniform vec2 rayScale;   // half the image's extents at distance 1
uniform mat3 toCamera;   // of directions
uniform float radius;    // in the scene's unit
uniform float mostPx;    // radius in the picture at most
uniform float bias;      // share of the radius by which a surface must be nearer
uniform float thickness;  // radii in front of the sphere beyond which a surface occludes nothing

const float kPi = 3.14159265;
const float kGolden = 0.61803399;
uint fetches = 0u;

vec3 rayAt(ivec2 pixel) {
  const vec2 ndc = vec2(2.0, -2.0) * (vec2(pixel) + 0.5) / vec2(sizePx) + vec2(-1.0, 1.0);
  return vec3(ndc * rayScale, -1.0);
}

// Depth of what a pixel sees; 0 where that is the background or outside the picture.
float depthAt(ivec2 pixel) {
  ++fetches;
  if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, sizePx))) return 0.0;
  return texelFetch(depths, pixel, 0).x;
}

struct Receiver {
  ivec2 pixel;
  vec3 position, normal;
  float reach, reachPx;
};

// Length of the line through a place of the kernel (in the unit disc) within the sphere and above the receiver's plane,
// and how much of it is open: all in front of the surface, or all or nothing at one of its points (`along`, 0..1).
vec2 openLine(Receiver at, vec2 place, float along) {
  const ivec2 pixel = at.pixel + ivec2(round(place * at.reachPx));
  const float depth = depthAt(pixel);
  const vec3 ray = rayAt(pixel);
  const float square = dot(ray, ray), middle = dot(ray, at.position) / square;
  const vec3 off = at.position - middle * ray;
  const float rest = at.reach * at.reach - dot(off, off);
  if (!(rest > 0.0)) return vec2(0.0);
  const float half_ = sqrt(rest / square), facing = dot(at.normal, ray);
  const float first = middle - half_;
  float last = middle + half_;
  if (facing < 0.0) last = min(last, dot(at.normal, at.position) / facing);
  const float length = max(last - first, 0.0);
  if (depth == 0.0 || depth < first - thickness * at.reach) return vec2(length);
#if METHOD == METHOD_POINTS
  return vec2(length, first + along * length <= depth + bias * at.reach ? length : 0.0);
#else
  return vec2(length, clamp(depth + bias * at.reach - first, 0.0, length));
#endif
}

// Occlusion along one direction of the picture: what surfaces rise above the receiver's plane, as the difference of sines
// of elevation over the plane across the view.
float horizonOcclusion(Receiver at, vec2 direction, int steps) {
  const vec3 up = -normalize(at.position);
  const vec3 aside = rayAt(at.pixel + ivec2(round(direction * 64.0))) - rayAt(at.pixel);
  const vec3 along = normalize(aside - dot(aside, up) * up);
  const float slope = -dot(at.normal, along) / max(dot(at.normal, up), 1e-4);
  const float tangent = slope / sqrt(1.0 + slope * slope);
  float horizon = tangent + bias;
  for (int i = 0; i < steps; ++i) {
    const ivec2 pixel = at.pixel + ivec2(round(direction * (at.reachPx * (float(i) + 0.5) / float(steps))));
    const float depth = depthAt(pixel);
    if (depth == 0.0 || pixel == at.pixel) continue;
    const vec3 to = rayAt(pixel) * depth - at.position;
    const float distance = length(to);
    if (distance > at.reach || !(distance > 0.0)) continue;
    horizon = max(horizon, dot(to, up) / distance);
  }
  return horizon - tangent - bias;
}

#if FORM == FORM_FULL
// From the square to the disc, areas in proportion (Shirley and Chiu 1997).
vec2 discPlace(vec2 s) {
  if (s == vec2(0.0)) return s;
  const bool wide = abs(s.x) > abs(s.y);
  const float r = wide ? s.x : s.y, phi = 0.25 * kPi * (wide ? s.y / s.x : 2.0 - s.x / s.y);
  return r * vec2(cos(phi), sin(phi));
}

float openShare(Receiver at) {
#if METHOD == METHOD_HORIZON
  float sum = 0.0;
  for (int i = 0; i < K; ++i) {
    const float phi = 2.0 * kPi * (float(i) + 0.5) / float(K);
    sum += horizonOcclusion(at, vec2(cos(phi), sin(phi)), K);
  }
  return 1.0 - sum / float(K);
#else
  vec2 sum = vec2(0.0);
  for (int y = 0; y < K; ++y)
    for (int x = 0; x < K; ++x) {
      const vec2 place = discPlace((2.0 * vec2(x, y) + 1.0) / float(K) - 1.0);
      sum += openLine(at, place, fract((float(y * K + x) + 0.5) * kGolden));
    }
  return sum.x > 0.0 ? sum.y / sum.x : 1.0;
#endif
}
#else
float openShare(Receiver at) {
#if FRAMES == FRAMES_RANDOM
  // Of a tile of TILE x TILE pixels each has a direction of its own within a quarter turn.
  const int index = at.pixel.x % TILE + TILE * (at.pixel.y % TILE);
  const float turn = fract((float(index) + 0.5) * kGolden);
#else
  const float turn = 0.0;
#endif
  const vec2 axis = vec2(cos(0.5 * kPi * turn), sin(0.5 * kPi * turn));
#if METHOD == METHOD_HORIZON
  const int steps = (K + 1) / 2;
  return 1.0 - 0.25 * (horizonOcclusion(at, axis, steps) + horizonOcclusion(at, -axis, steps) +
                       horizonOcclusion(at, vec2(-axis.y, axis.x), steps) +
                       horizonOcclusion(at, vec2(axis.y, -axis.x), steps));
#else
  float share = 0.0;
  for (int pass = 0; pass < 2; ++pass) {
    const vec2 direction = pass == 0 ? axis : vec2(-axis.y, axis.x);
    vec2 sum = vec2(0.0);
    for (int i = 0; i < K; ++i) {
      const float s = float(2 * i + 1 - K) / float(K);
#if WEIGHTS == WEIGHTS_RADIAL
      const float weight = abs(s);
#else
      const float weight = 1.0;
#endif
      sum += weight * openLine(at, s * direction, fract((float(pass * K + i) + 0.5) * kGolden + turn));
    }
    share += sum.x > 0.0 ? 0.5 * sum.y / sum.x : 0.5;
  }
  return share;
#endif
}
#endif

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const float depth = texelFetch(depths, pixel, 0).x;
  vec4 packed_ = vec4(1.0, 0.0, 0.0, 0.0);
  if (depth > 0.0) {
    Receiver at;
    at.pixel = pixel;
    at.position = rayAt(pixel) * depth;
    at.normal = toCamera * texelFetch(normals, pixel, 0).xyz;
    const float pxPerUnit = 0.5 * float(sizePx.y) / (rayScale.y * depth);
    at.reach = min(radius, mostPx / pxPerUnit);
    at.reachPx = at.reach * pxPerUnit;
    packed_ = vec4(clamp(openShare(at), 0.0, 1.0), depth, at.normal.xy);
  }
  imageStore(outPacked, pixel, packed_);
#ifdef COUNT
  atomicAdd(fetchCounts[(gl_WorkGroupID.x + gl_WorkGroupID.y) % uint(kOcclusionSlots)], fetches);
#endif
}
