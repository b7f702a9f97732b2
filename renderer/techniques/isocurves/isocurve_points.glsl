// SPDX-License-Identifier: BSD-3-Clause
// Points of a bicubic patch on the screen. The first pass finds the nearest depth of each pixel, the second one what lies
// there. COUNTING: the first pass, with what it costs. See isocurves.cpp.
#include "renderer/techniques/isocurves/isocurves_bindings.h"
#include "renderer/techniques/tessellation/evaluate.glsl"

layout(local_size_x = kIsocurveGroup) in;
layout(binding = kIsocurveDepthImage, r32ui) uniform uimage2D depths;
#ifdef SURFACE_PASS
layout(binding = kIsocurveIdsImage, r32ui) uniform writeonly uimage2D ids;
layout(binding = kIsocurveNormalsImage, rgba32f) uniform writeonly image2D normals;
#endif
#ifdef COUNTING
layout(binding = kIsocurveCountsImage, r32ui) uniform uimage2D counts;
layout(std430, binding = kIsocurveDriftBuffer) buffer Drift { uint mostDrift, mostSteps, filledPieces, mostRounds; };
#endif

uniform mat4 anchorToClip;
uniform vec3 eye;       // relative to the anchor
uniform ivec2 sizePx;
uniform float nearest;  // along the view
uniform float spacing;  // px, of points and of curves
uniform uint restart;   // steps after which the differences are computed anew

TessellatedPatch patch_ = TessellatedPatch(0u, 0u, 0u, 0u, ivec4(-1));

// x and y in pixels from the top left corner times the distance along the view; z: unused; w: that distance.
vec4 clipPoint(int i) {
  precise const vec4 clip = anchorToClip * patchPoints[patch_.firstPoint + uint(i)];
  precise const vec4 out_ = vec4((0.5 * clip.x + 0.5 * clip.w) * float(sizePx.x), (0.5 * clip.w - 0.5 * clip.y) * float(sizePx.y), 0.0, clip.w);
  return out_;
}

// Points, or curves, along u or v: degree times the largest distance of successive control points (Rockwood 1987).
uint stepsAlong(vec4 points[16], int stride, int across) {
  float most = 0.0;
  for (int row = 0; row < 4; ++row)
    for (int i = 0; i < 3; ++i) {
      const vec4 a = points[row * across + i * stride], b = points[row * across + (i + 1) * stride];
      if (a.w < nearest || b.w < nearest) return uint(kMostIsocurves);
      most = max(most, distance(a.xy / a.w, b.xy / b.w));
    }
  return uint(clamp(ceil(3.0 * most / spacing), 1.0, float(kMostIsocurves)));
}

void plot(vec4 p, float u, float v) {
  if (!(p.w >= nearest)) return;
  precise const vec2 at = p.xy / p.w;
  const ivec2 pixel = ivec2(floor(at));
  if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, sizePx))) return;
  const uint depth = floatBitsToUint(nearest / p.w);
#ifdef SURFACE_PASS
  // Points are precise, so that both programs put the same ones into the same pixels; within 16 units in the last place a
  // depth is that of the same point.
  if (depth + 16u < imageLoad(depths, pixel).x) return;
  const TessellatedVertex vertex = surfaceVertex(patch_, vec4(u, v, 1.0 - u, 1.0 - v));
  const vec3 normal = dot(vertex.normal, vertex.position - eye) > 0.0 ? -vertex.normal : vertex.normal;
  imageStore(ids, pixel, uvec4(kSurfaceOfPatch | vertex.material));
  imageStore(normals, pixel, vec4(normal, p.w));
#else
  imageAtomicMax(depths, pixel, depth);
#endif
#ifdef COUNTING
  imageAtomicAdd(counts, pixel, 1u);
#endif
}

struct Walk {
  vec4 p, d1, d2, d3;  // point, and differences to the next ones
};

Walk walkFrom(vec4 c[4], float t, float h) {
  const float s = 1.0 - t;
  precise const vec4 a = mix(c[0], c[1], t), b = mix(c[1], c[2], t), d = mix(c[2], c[3], t);
  precise const vec4 first = 3.0 * (s * s * (c[1] - c[0]) + 2.0 * s * t * (c[2] - c[1]) + t * t * (c[3] - c[2])),
             second = 6.0 * (s * (c[2] - 2.0 * c[1] + c[0]) + t * (c[3] - 2.0 * c[2] + c[1])),
             third = 6.0 * (c[3] - 3.0 * c[2] + 3.0 * c[1] - c[0]);
  precise Walk w;
  w.p = mix(mix(a, b, t), mix(b, d, t), t);
  w.d1 = h * first + 0.5 * h * h * second + h * h * h / 6.0 * third;
  w.d2 = h * h * second + h * h * h * third;
  w.d3 = h * h * h * third;
  return w;
}

void step_(inout Walk w) {
  precise const vec4 p = w.p + w.d1, d1 = w.d1 + w.d2, d2 = w.d2 + w.d3;
  w = Walk(p, d1, d2, w.d3);
}
