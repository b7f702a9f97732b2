// SPDX-License-Identifier: BSD-3-Clause
// Follows each mirrored ray through the depths of the picture. See screen_space.cpp.
#include "renderer/techniques/reflections/reflection_bindings.h"
#include "renderer/techniques/reflections/screen_space/screen_space_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kReflectionOriginsUnit) uniform sampler2D origins;
layout(binding = kReflectionDirectionsUnit) uniform sampler2D directions;
layout(binding = kReflectionIdsUnit) uniform usampler2D triangleIds;
layout(binding = kScreenPictureUnit) uniform sampler2D picture;
layout(binding = kScreenDepthUnit) uniform sampler2D depths;
layout(binding = kScreenPyramidUnit) uniform sampler2D pyramid;  // level l of the pyramid is mip level l - 1
layout(binding = kScreenBehindDepthUnit) uniform sampler2D behindDepths;
layout(binding = kScreenSecondIdsUnit) uniform usampler2D secondIds;
layout(binding = kReflectionImage, rgba32f) uniform writeonly image2D outImage;
layout(binding = kScreenFateImage, r32ui) uniform writeonly uimage2D fates;

uniform ivec2 sizePx;
uniform int mostSteps;
uniform float thickness;  // world units
uniform float fade;       // width of the border along which reflections fade, px
#ifdef LINEAR
uniform float stride, jitter;
uniform int refinements;
uniform uint seed;
#else
uniform int coarsest;
#endif
uniform bool flatShading;
#include "renderer/frame/shading.glsl"
#include "renderer/techniques/reflections/screen_space/screen_ray.glsl"

#ifdef LIT
float sunShare(ivec2 pixel, SeenPoint seen) { return 1.0; }
#endif

struct Met {
  bool met;
  vec4 colour;
  float u;
};
vec3 rayOrigin = vec3(0.0), rayDirection = vec3(0.0);  // relative to the anchor
bool hidden = false;           // the ray went behind a surface
bool cut = false;               // the most steps were not enough
uint steps = 0u;

// Distance along the view of the far side of what a pixel shows, `depth` being its reversed depth.
float farSide(ivec2 pixel, float depth) {
  const float side = near / depth;
#if THICKNESS == THICKNESS_BACK_FACES
  const float back = texelFetch(behindDepths, pixel, 0).x;
  // Without a back face, an open surface.
  if (back > 0.0) return max(near / back, side + thickness);
#elif THICKNESS == THICKNESS_SECOND_LAYER
  const float second = texelFetch(behindDepths, pixel, 0).x;
  if (second > 0.0) return min(near / second, side + thickness);
#endif
  return side + thickness;
}

// True if the ray, whose depths between two places are a and b, is neither before nor behind the surface all of the way.
bool reaches(float depth, float side, float a, float b) { return min(a, b) < depth && side * max(a, b) >= near; }

// What a ray brings that meets a triangle at a pixel: nothing, if it comes from the side that the picture does not show, as
// rays do that have only just left the triangle or its neighbour.
bool brings(ivec2 pixel, uint id, inout Met met) {
  const uvec3 vertices = sceneTriangle(id);
  const vec3 a = scenePosition(vertices.x), b = scenePosition(vertices.y), c = scenePosition(vertices.z);
  const vec3 e1 = b - a, e2 = c - a, reach = max(abs(e1), abs(e2));
  const vec3 normal = cross(e1 / max(reach.x, max(reach.y, reach.z)), e2 / max(reach.x, max(reach.y, reach.z)));
  const float slant = dot(normal, rayDirection), side = dot(normal, eye - a);
  if (!(slant * side < 0.0)) return false;
#ifdef LIGHT_TRIANGLE
  const float t = dot(normal, a - rayOrigin) / slant;
  if (!(t > 0.0)) return false;
  const vec3 at = rayOrigin + t * rayDirection, seen = screenPlace(anchorToCamera * vec4(at, 1.0));
  // The step ends within a pixel of where the ray meets the plane, or the triangle is another's.
  if (!(seen.z > 0.0) || any(greaterThan(abs(seen.xy / seen.z - vec2(pixel) - 0.5), vec2(1.5)))) return false;
  SurfacePoint point = surfaceHit(id, barycentrics(a, b, c, at), rayDirection);
  if (flatShading) point.normal = point.flatNormal;
  met.colour = vec4(pointColour(point, 1.0), 1.0);
#endif
  return true;
}

// Whether the ray meets what a pixel shows between places u0 and u1, at depths a and b.
bool meetsAt(ivec2 pixel, float u1, float a, float b, inout Met met) {
  const float depth = texelFetch(depths, pixel, 0).x;
  if (!(depth > 0.0) || min(a, b) >= depth) return false;
  met.u = u1;
  if (reaches(depth, farSide(pixel, depth), a, b)) {
    if (brings(pixel, texelFetch(triangleIds, pixel, 0).x, met)) {
#ifndef LIGHT_TRIANGLE
      met.colour = texelFetch(picture, pixel, 0);
#endif
      return true;
    }
    return false;
  }
#if THICKNESS == THICKNESS_SECOND_LAYER
  const float second = texelFetch(behindDepths, pixel, 0).x;
  if (second > 0.0) {
    if (min(a, b) >= second) return false;
    if (reaches(second, near / second + thickness, a, b)) {
      const uint id = texelFetch(secondIds, pixel, 0).x;
      if (!brings(pixel, id, met)) return false;
#ifndef LIGHT_TRIANGLE
      SeenPoint seen;
      SurfacePoint point = surfaceSeen(pixel, id, seen);
      if (flatShading) point.normal = point.flatNormal;
      met.colour = vec4(pointColour(point, 1.0), 1.0);
#endif
      return true;
    }
  }
#endif
  hidden = true;
  return false;
}

// What the ray passes is not in the picture: its back, or nothing.
bool givesUp() {
#ifdef GIVE_UP
  return hidden;
#else
  return false;
#endif
}

ivec2 pixelAt(vec2 place) { return clamp(ivec2(floor(place)), ivec2(0), sizePx - 1); }

#ifdef LINEAR
// Of a pixel, in [0, 1) (a hash of 32 bits, multiplied and folded three times).
float randomOf(ivec2 pixel) {
  uint h = seed * 0x9e3779b9u + uint(pixel.y) * 0x85ebca6bu + uint(pixel.x);
  h = (h ^ (h >> 16)) * 0x7feb352du;
  h = (h ^ (h >> 15)) * 0x846ca68bu;
  return float((h ^ (h >> 16)) >> 8) * 5.9604645e-8;
}

bool behindAt(ScreenRay ray, float u) {
  return ray.depth + u * ray.depthAlong < texelFetch(depths, pixelAt(ray.start + u * ray.along), 0).x;
}

Met march(ScreenRay ray, ivec2 own) {
  Met met = Met(false, vec4(0.0), 0.0);
  const float length_ = max(max(abs(ray.along.x), abs(ray.along.y)), 1.0e-3);
  const float px = min(1.0 / length_, 1.0), step = min(stride / length_, 1.0);
  float before = 0.0, u = step * (1.0 - jitter * randomOf(own));
  bool wasBehind = false;
  for (;;) {
    if (int(steps) == mostSteps) {
      cut = true;
      return met;
    }
    ++steps;
    u = min(u, 1.0);
    const bool behind = behindAt(ray, u);
    if (behind) {
      // The last pixel of the step, or the pixel after the place where the ray went behind the surface.
      float low = max(before, u - px), high = u, last = u;
      if (!wasBehind) {
        low = before;
        for (int i = 0; i < refinements; ++i) {
          const float middle = 0.5 * (low + high);
          if (behindAt(ray, middle)) high = middle;
          else low = middle;
        }
        last = min(max(low + px, high), 1.0);
      }
      if (meetsAt(pixelAt(ray.start + high * ray.along), high, ray.depth + low * ray.depthAlong,
                  ray.depth + last * ray.depthAlong, met)) {
        met.met = true;
        return met;
      }
    }
    if (u >= 1.0 || givesUp()) return met;
    wasBehind = behind;
    before = u;
    u += step;
  }
}
#else
// From cell to cell, of the coarsest level whose nearest surface the ray stays in front of.
Met march(ScreenRay ray, ivec2 own) {
  Met met = Met(false, vec4(0.0), 0.0);
  const vec2 span = abs(ray.along);
  // Past a border by this much: more than rounding, so that each step makes progress.
  const float past = min(2.0e-3 / max(max(span.x, span.y), 2.0e-3), 1.0);
  float u = 0.0;
  int level = 0;
  while (u < 1.0) {
    if (int(steps) == mostSteps) {
      cut = true;
      return met;
    }
    ++steps;
    const vec2 place = ray.start + u * ray.along;
    const ivec2 pixel = pixelAt(place), cell = pixel >> level;
    float next = 1.0;
    for (int axis = 0; axis < 2; ++axis)
      if (span[axis] > 0.0) {
        const float border = float((ray.along[axis] > 0.0 ? cell[axis] + 1 : cell[axis]) << level);
        next = min(next, max((border - ray.start[axis]) / ray.along[axis], u));
      }
    next = min(next + past, 1.0);
    const float a = ray.depth + u * ray.depthAlong, b = ray.depth + next * ray.depthAlong;
    if (level == 0) {
      if (meetsAt(pixel, next, a, b, met)) {
        met.met = true;
        return met;
      }
      if (givesUp()) return met;
    } else {
      const float nearest = texelFetch(pyramid, cell, level - 1).x;
      if (min(a, b) < nearest) {
        // In front of all of the cell up to there.
        if (a > nearest) u = clamp((nearest - ray.depth) / ray.depthAlong, u, next);
        --level;
        continue;
      }
    }
    u = next;
    level = min(level + 1, coarsest);
  }
  return met;
}
#endif

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const vec4 origin = texelFetch(origins, pixel, 0);
  uint fate = kScreenNoRay;
  vec4 found = vec4(0.0);
  if (origin.w > 0.0) {
    rayOrigin = origin.xyz;
    rayDirection = texelFetch(directions, pixel, 0).xyz;
    const ScreenRay ray = screenRay(rayOrigin, rayDirection);
    const Met met = march(ray, pixel);
    if (met.met) {
      fate = kScreenMet;
      const vec2 at = ray.start + met.u * ray.along, inside = min(at, vec2(sizePx) - at);
      const float share = fade > 0.0 ? clamp(min(inside.x, inside.y) / fade, 0.0, 1.0) : 1.0;
      found = share * vec4(met.colour.rgb, 1.0);
    } else if (cut) {
      fate = kScreenCut;
    } else if (givesUp()) {
      fate = kScreenHidden;
    } else if (ray.leaves) {
      fate = kScreenLeft;
    } else if (hidden) {
      fate = kScreenHidden;
    } else {
      fate = kScreenFree;
      found = vec4(background, 1.0);
    }
#ifdef NO_FALLBACK
    found.a = 1.0;
#endif
    imageStore(outImage, pixel, found);
  }
#ifdef COUNT
  imageStore(fates, pixel, uvec4(fate | steps << kScreenFateBits));
#endif
}
