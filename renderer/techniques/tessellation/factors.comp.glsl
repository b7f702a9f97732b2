// SPDX-License-Identifier: BSD-3-Clause
// Phase 1: factors of each patch for itself, 0 where it lies outside the view. See factor_pass.h.
#include "renderer/surfaces/factor_rules.h"
#include "renderer/techniques/tessellation/patches.glsl"

layout(local_size_x = kTessellationGroup) in;
layout(std430, binding = kOwnFactorsBuffer) writeonly buffer OwnFactors { uint ownFactors[]; };

uniform uint patchCount;
uniform mat4 anchorToCamera;
uniform vec2 rayScale;       // half the picture's extents at distance 1
uniform float nearest;       // distance of the near plane
uniform float tolerance;     // object space at distance 1
uniform int mostSegments;    // <= kMostSegments
uniform int uniformSegments; // 0: by deviation
uniform int cull, strict;

vec3 projected(vec4 p) { return p.w == 0.0 ? p.xyz : p.xyz / p.w; }

int whole(float segments) {
  return segments <= float(mostSegments) ? max(1, int(ceil(segments))) : mostSegments;  // a NaN: all
}

float size4(vec4 difference, float reach) { return length(difference.xyz) + reach * abs(difference.w); }

void main() {
  const uint number = gl_GlobalInvocationID.x;
  if (number >= patchCount) return;
  const TessellatedPatch patch_ = patches[number];
  const uint shape = shapeOf(patch_);
  const int count = pointCount(shape), first = int(patch_.firstPoint);

  vec3 low = vec3(3e38), high = vec3(-3e38);
  float least = 3e38, weight = 3e38, offAxis = 0.0;
  bool left = true, right = true, above = true, below = true, behind = true, finite = true;
  for (int i = 0; i < count; ++i) {
    const vec4 point = patchPoints[first + i];
    const vec3 p = projected(point), seen = (anchorToCamera * vec4(p, 1.0)).xyz;
    weight = min(weight, point.w);
    finite = finite && point.w > 0.0;
    low = min(low, p);
    high = max(high, p);
    const float depth = -seen.z;
    least = min(least, depth);
    left = left && seen.x < -rayScale.x * depth;
    right = right && seen.x > rayScale.x * depth;
    below = below && seen.y < -rayScale.y * depth;
    above = above && seen.y > rayScale.y * depth;
    behind = behind && depth < nearest;
    const float near_ = max(depth, nearest);
    offAxis = max(offAxis, dot(seen.xy, seen.xy) / (near_ * near_));
  }
  // Only a patch with positive weights lies within the hull of its control points.
  if (cull != 0 && finite && (left || right || below || above || behind)) {
    ownFactors[number] = 0u;
    return;
  }
  if (uniformSegments > 0) {
    ownFactors[number] = packedFactors(ivec4(uniformSegments));
    return;
  }
  float eps = tolerance * max(least, nearest);
  if (strict != 0) eps /= sqrt(1.0 + min(offAxis, dot(rayScale, rayScale)));
  if (!finite) {
    ownFactors[number] = packedFactors(ivec4(mostSegments));
    return;
  }
  const vec3 centre = 0.5 * (low + high);

  if (isRectangle(shape)) {
    // Bounds of Zheng and Sederberg 2000 with the origin in the middle; as derivativeBounds() of factors.h.
    const int m = degreeU(shape), n = degreeV(shape);
    float reach = 0.0;
    for (int i = 0; i < count; ++i) reach = max(reach, length(projected(patchPoints[first + i]) - centre));
    reach = max(reach - eps, 0.0);
    float uu = 0.0, uv = 0.0, vv = 0.0;
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= m; ++i) {
        const int at = first + i + (m + 1) * j;
        vec4 p = patchPoints[at];
        p.xyz -= p.w * centre;
        if (i + 1 <= m) {
          vec4 a = patchPoints[at + 1];
          a.xyz -= a.w * centre;
          if (i + 2 <= m) {
            vec4 b = patchPoints[at + 2];
            b.xyz -= b.w * centre;
            uu = max(uu, size4(b - 2.0 * a + p, reach));
          }
          if (j + 1 <= n) {
            vec4 c = patchPoints[at + m + 1], d = patchPoints[at + m + 2];
            c.xyz -= c.w * centre;
            d.xyz -= d.w * centre;
            uv = max(uv, size4(d - a - c + p, reach));
          }
        }
        if (j + 2 <= n) {
          vec4 a = patchPoints[at + m + 1], b = patchPoints[at + 2 * (m + 1)];
          a.xyz -= a.w * centre;
          b.xyz -= b.w * centre;
          vv = max(vv, size4(b - 2.0 * a + p, reach));
        }
      }
    uu *= float(m * (m - 1));
    vv *= float(n * (n - 1));
    uv *= float(m * n);
    const vec2 segments = segmentsWithin(uu, uv, vv, 8.0 * eps * weight, RULE, float(mostSegments));
    const int mu = whole(segments.x), mv = whole(segments.y);
    ownFactors[number] = packedFactors(ivec4(mu, mv, mu, mv));
    return;
  }
  // Schwarz 2009, section 7.4.3; as triangleSegments() of factors.h. Of a rational one no bound is known.
  const int n = degreeU(shape);
  float own0 = 0.0, own1 = 0.0, own2 = 0.0, d13 = 0.0, d21 = 0.0, d32 = 0.0;
  float heaviest = 0.0;
  for (int i = 0; i < count; ++i) heaviest = max(heaviest, patchPoints[first + i].w);
  for (int i = 0; i <= n - 2; ++i)
    for (int k = 0; i + k <= n - 2; ++k) {
      const vec3 a = projected(patchPoints[first + trianglePlace(n, i + 2, k)]),
                 b = projected(patchPoints[first + trianglePlace(n, i, k)]),
                 c = projected(patchPoints[first + trianglePlace(n, i, k + 2)]),
                 ab = projected(patchPoints[first + trianglePlace(n, i + 1, k)]),
                 bc = projected(patchPoints[first + trianglePlace(n, i, k + 1)]),
                 ca = projected(patchPoints[first + trianglePlace(n, i + 1, k + 1)]);
      own0 = max(own0, length(b - 2.0 * ab + a));
      own1 = max(own1, length(c - 2.0 * bc + b));
      own2 = max(own2, length(a - 2.0 * ca + c));
      d13 = max(d13, length(bc - ab - ca + a));
      d21 = max(d21, length(ca - bc - ab + b));
      d32 = max(d32, length(ab - ca - bc + c));
    }
  const vec3 bounds = float(n * (n - 1)) * vec3(own0 + max(d13, d21), own1 + max(d21, d32), own2 + max(d13, d32));
  const vec3 segments = heaviest > weight ? vec3(float(mostSegments)) : sqrt(bounds / (4.0 * eps));
  ownFactors[number] = packedFactors(ivec4(whole(segments.x), whole(segments.y), whole(segments.z), 0));
}
