// SPDX-License-Identifier: BSD-3-Clause
// Phase 1: factors of each patch for itself, 0 where it lies outside the view. COUNT_CAPPED: in their place, whether more
// segments would be needed. See factor_pass.h.
#include "renderer/surfaces/factor_rules.h"
#include "renderer/surfaces/spacing.h"
#include "renderer/techniques/tessellation/patches.glsl"

layout(local_size_x = kTessellationGroup) in;
layout(std430, binding = kOwnFactorsBuffer) writeonly buffer OwnFactors { uvec2 ownFactors[]; };

#ifdef BOUNDS_MADE
layout(std430, binding = kPatchBoundsBuffer) readonly buffer Bounds { PatchBounds bounds[]; };
#else
layout(std430, binding = kPatchBoundsBuffer) writeonly buffer Bounds { PatchBounds bounds[]; };
#endif

uniform uint patchCount;
uniform mat4 anchorToCamera;
uniform vec2 rayScale;       // half the picture's extents at distance 1
uniform float nearest;       // distance of the near plane
uniform float tolerance;     // object space at distance 1
uniform int mostSegments;    // <= kMostSegments
uniform int uniformSegments; // 0: by deviation
uniform int cull, strict;

uniform float commonDepth;    // > 0: one tolerance for all patches, that of this distance
uniform float pxAtDistance;   // pixels of a unit at distance 1
uniform float tolerancePx;
uniform float segmentPx;      // SIZE: pixels that a segment may have

// What is bounded. SCREEN: pixels, with weights that hold the distance.
vec4 boundedPoint(int at) {
#ifdef SCREEN
  const vec4 p = anchorToCamera * patchPoints[at];
  return vec4(p.xy * pxAtDistance, 0.0, -p.z);
#else
  return patchPoints[at];
#endif
}

vec3 projected(vec4 p) { return p.w == 0.0 ? p.xyz : p.xyz / p.w; }

bool capped = false;  // more segments would be needed

// A NaN counts as too many. Rounded up, so that a bound is kept.
int units(float segments) {
  if (!(segments <= float(mostSegments))) {
    capped = true;
    return mostSegments * kSegmentUnit;
  }
  return max(kSegmentUnit, int(ceil(segments * float(kSegmentUnit))));
}

float size4(vec4 difference, float reach) { return length(difference.xyz) + reach * abs(difference.w); }

// Box, weights; whether they are all positive.
PatchBounds boxOf(int first, int count) {
  PatchBounds out_;
  out_.low = vec3(3e38);
  out_.high = vec3(-3e38);
  out_.weight = 3e38;
  out_.finite = 1u;
  out_.second = vec3(0.0);
  out_.unused = 0.0;
  for (int i = 0; i < count; ++i) {
    const vec4 point = boundedPoint(first + i);
    const vec3 p = projected(point);
    out_.weight = min(out_.weight, point.w);
    if (!(point.w > 0.0)) out_.finite = 0u;
    out_.low = min(out_.low, p);
    out_.high = max(out_.high, p);
  }
  return out_;
}

// Bounds of Zheng and Sederberg 2000 with the origin in the middle; as derivativeBounds() of factors.h.
vec3 rectangleBounds(int first, uint shape, vec3 centre, float eps) {
  const int m = degreeU(shape), n = degreeV(shape), count = pointCount(shape);
  float reach = 0.0;
  for (int i = 0; i < count; ++i) reach = max(reach, length(projected(boundedPoint(first + i)) - centre));
  reach = max(reach - eps, 0.0);
  float uu = 0.0, uv = 0.0, vv = 0.0;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= m; ++i) {
      const int at = first + i + (m + 1) * j;
      vec4 p = boundedPoint(at);
      p.xyz -= p.w * centre;
      if (i + 1 <= m) {
        vec4 a = boundedPoint(at + 1);
        a.xyz -= a.w * centre;
        if (i + 2 <= m) {
          vec4 b = boundedPoint(at + 2);
          b.xyz -= b.w * centre;
          uu = max(uu, size4(b - 2.0 * a + p, reach));
        }
        if (j + 1 <= n) {
          vec4 c = boundedPoint(at + m + 1), d = boundedPoint(at + m + 2);
          c.xyz -= c.w * centre;
          d.xyz -= d.w * centre;
          uv = max(uv, size4(d - a - c + p, reach));
        }
      }
      if (j + 2 <= n) {
        vec4 a = boundedPoint(at + m + 1), b = boundedPoint(at + 2 * (m + 1));
        a.xyz -= a.w * centre;
        b.xyz -= b.w * centre;
        vv = max(vv, size4(b - 2.0 * a + p, reach));
      }
    }
  return vec3(float(m * (m - 1)) * uu, float(m * n) * uv, float(n * (n - 1)) * vv);
}

#ifdef PN_CONSTANT
float tangentDistance(vec3 p, vec3 a, vec3 b) {
  const vec3 along = b - a, away = p - a;
  const float length2 = dot(along, along);
  return length(length2 > 0.0 ? away - along * (dot(away, along) / length2) : away);
}
#endif

// As triangleSegments() and largestTangentDistance() of factors.h. Of a rational one no bound is known.
vec3 triangleBounds(int first, int n) {
#ifdef PN_CONSTANT
  if (n == 3) {
    vec3 b[10];
    for (int i = 0; i < 10; ++i) b[i] = projected(patchPoints[first + i]);
    // b300, 210, 201, 120, 111, 102, 030, 021, 012, 003
    const float edge0 = max(tangentDistance(b[1], b[0], b[6]), tangentDistance(b[3], b[0], b[6])),
                edge1 = max(tangentDistance(b[7], b[6], b[9]), tangentDistance(b[8], b[6], b[9])),
                edge2 = max(tangentDistance(b[2], b[0], b[9]), tangentDistance(b[5], b[0], b[9]));
    return vec3(max(edge0, max(edge1, edge2)));
  }
#endif
  float own0 = 0.0, own1 = 0.0, own2 = 0.0, d13 = 0.0, d21 = 0.0, d32 = 0.0;
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
  return float(n * (n - 1)) * vec3(own0 + max(d13, d21), own1 + max(d21, d32), own2 + max(d13, d32));
}

float heaviest(int first, int count) {
  float out_ = 0.0;
  for (int i = 0; i < count; ++i) out_ = max(out_, patchPoints[first + i].w);
  return out_;
}

#ifdef MOVING
// Over a whole period: p + s a + c b with s^2 + c^2 = 1 is at most |p| + sqrt(|a|^2 + |b|^2), for points and for all
// differences of them alike. The points themselves are those at rest.
layout(std430, binding = kPointMotionsBuffer) readonly buffer Motions { PointMotion motions[]; };

float sizeOfSum(ivec4 at, vec4 by, vec3 centre, float reach) {
  vec4 rest = vec4(0.0);
  vec3 a = vec3(0.0), b = vec3(0.0);
  for (int k = 0; k < 4; ++k) {
    const PointMotion motion = motions[at[k]];
    rest += by[k] * vec4(motion.rest.xyz - motion.rest.w * centre, motion.rest.w);
    a += by[k] * motion.sine.xyz;
    b += by[k] * motion.cosine.xyz;
  }
  return size4(rest, reach) + sqrt(dot(a, a) + dot(b, b));
}

PatchBounds movingBounds(int first, uint shape) {
  const int m = degreeU(shape), n = degreeV(shape), count = pointCount(shape);
  PatchBounds out_ = boxOf(first, count);
  if (out_.finite == 0u) return out_;
  for (int i = 0; i < count; ++i) {
    const PointMotion motion = motions[first + i];
    const vec3 p = projected(motion.rest), a = motion.sine.xyz / motion.rest.w, b = motion.cosine.xyz / motion.rest.w;
    const vec3 away = sqrt(a * a + b * b);
    out_.low = min(out_.low, p - away);
    out_.high = max(out_.high, p + away);
  }
  const vec3 centre = 0.5 * (out_.low + out_.high);
  float reach = 0.0;
  for (int i = 0; i < count; ++i) {
    const PointMotion motion = motions[first + i];
    const vec3 a = motion.sine.xyz / motion.rest.w, b = motion.cosine.xyz / motion.rest.w;
    reach = max(reach, length(projected(motion.rest) - centre) + sqrt(dot(a, a) + dot(b, b)));
  }
  const vec4 bend = vec4(1.0, -2.0, 1.0, 0.0), twist = vec4(1.0, -1.0, -1.0, 1.0);
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= m; ++i) {
      const int at = first + i + (m + 1) * j, row = m + 1;
      if (i + 2 <= m)
        out_.second.x = max(out_.second.x, sizeOfSum(ivec4(at, at + 1, at + 2, at), bend, centre, reach));
      if (i + 1 <= m && j + 1 <= n)
        out_.second.y = max(out_.second.y, sizeOfSum(ivec4(at, at + 1, at + row, at + row + 1), twist, centre, reach));
      if (j + 2 <= n)
        out_.second.z = max(out_.second.z, sizeOfSum(ivec4(at, at + row, at + 2 * row, at), bend, centre, reach));
    }
  out_.second *= vec3(float(m * (m - 1)), float(m * n), float(n * (n - 1)));
  return out_;
}
#endif

vec3 secondBounds(int first, uint shape, PatchBounds box, float eps) {
  if (isRectangle(shape)) return rectangleBounds(first, shape, 0.5 * (box.low + box.high), eps);
  // So large that any tolerance takes all segments.
  if (heaviest(first, pointCount(shape)) > box.weight) return vec3(3e38);
  return triangleBounds(first, degreeU(shape));
}

ivec4 triangleUnits(vec3 second, float eps, int degree) {
#ifdef PN_CONSTANT
  if (degree == 3) return ivec4(units(second.x <= eps ? 1.0 : sqrt(PN_CONSTANT * second.x / eps)));
#endif
  const vec3 segments = sqrt(second / (4.0 * eps));
  return ivec4(units(segments.x), units(segments.y), units(segments.z), 0);
}

#ifdef SIZE
// Sizes on the screen, as sizeOf() of factors.h. 0: chord, 1: Rockwood, 2: Kumar.
vec2 onScreen(int at) {
  const vec3 p = (anchorToCamera * vec4(projected(patchPoints[at]), 1.0)).xyz;
  return p.xy * (pxAtDistance / max(-p.z, nearest));
}

// Of a part of the net: successive points `step_` apart.
void stretch(inout vec3 most, int at, int step_) {
  const vec2 d = onScreen(at + step_) - onScreen(at);
  most = max(most, vec3(length(d), abs(d)));
}

float sizeOf(vec3 most, int degree) { return float(degree) * (SIZE == 1 ? most.x : length(most.yz)); }

ivec4 unitsOfSizes(vec4 sizes) {
  const vec4 segments = sizes / segmentPx;
  return ivec4(units(segments.x), units(segments.y), units(segments.z), units(segments.w));
}

// Of the four sides, or of all curves of the net in either direction.
vec4 rectangleSizes(int first, int m, int n) {
#if SIZE == 0
  const vec2 a = onScreen(first), b = onScreen(first + m), c = onScreen(first + (m + 1) * (n + 1) - 1),
             d = onScreen(first + (m + 1) * n);
  return vec4(distance(a, b), distance(b, c), distance(c, d), distance(d, a));
#else
  vec3 u = vec3(0.0), v = vec3(0.0);
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= m; ++i) {
      const int at = first + i + (m + 1) * j;
      if (i < m) stretch(u, at, 1);
      if (j < n) stretch(v, at, m + 1);
    }
  return vec2(sizeOf(u, m), sizeOf(v, n)).xyxy;
#endif
}

// Of the three sides, or of all lines of the net along each of them.
vec4 triangleSizes(int first, int n) {
#if SIZE == 0
  const vec2 a = onScreen(first), b = onScreen(first + trianglePlace(n, 0, 0)), c = onScreen(first + trianglePlace(n, 0, n));
  return vec4(distance(a, b), distance(b, c), distance(c, a), 0.0);
#else
  vec3 side0 = vec3(0.0), side1 = vec3(0.0), side2 = vec3(0.0);
  for (int i = 0; i < n; ++i)
    for (int k = 0; i + k < n; ++k) {
      // The corners of one upright triangle of the net.
      const int u = first + trianglePlace(n, i + 1, k), v = first + trianglePlace(n, i, k),
                w = first + trianglePlace(n, i, k + 1);
      stretch(side0, u, v - u);
      stretch(side1, v, w - v);
      stretch(side2, w, u - w);
    }
  return vec4(sizeOf(side0, n), sizeOf(side1, n), sizeOf(side2, n), 0.0);
#endif
}
#endif

// What the view shows of a patch.
struct Seen {
  float least, offAxis;  // least depth; largest squared tangent of the angle to the axis
  bool left, right, above, below, behind;
};

void see(inout Seen seen, vec3 point) {
  const vec3 p = (anchorToCamera * vec4(point, 1.0)).xyz;
  const float depth = -p.z, near_ = max(depth, nearest);
  seen.least = min(seen.least, depth);
  seen.left = seen.left && p.x < -rayScale.x * depth;
  seen.right = seen.right && p.x > rayScale.x * depth;
  seen.below = seen.below && p.y < -rayScale.y * depth;
  seen.above = seen.above && p.y > rayScale.y * depth;
  seen.behind = seen.behind && depth < nearest;
  seen.offAxis = max(seen.offAxis, dot(p.xy, p.xy) / (near_ * near_));
}

#ifndef MAKE_BOUNDS
uvec2 factorsOf(uint number, uint shape, int first) {
  const int count = pointCount(shape);
  Seen seen = Seen(3e38, 0.0, true, true, true, true, true);
#ifdef BOUNDS_MADE
  const PatchBounds box = bounds[number];
  for (int i = 0; i < 8; ++i) see(seen, mix(box.low, box.high, vec3(i & 1, i >> 1 & 1, i >> 2)));
#else
  const PatchBounds box = boxOf(first, count);
  for (int i = 0; i < count; ++i) see(seen, projected(patchPoints[first + i]));
#endif
  // Only a patch with positive weights lies within the hull of its control points.
#ifdef SCREEN
  bool inHull = true;
  for (int i = 0; i < count; ++i) inHull = inHull && patchPoints[first + i].w > 0.0;
#else
  const bool inHull = box.finite != 0u;
#endif
  if (cull != 0 && inHull && (seen.left || seen.right || seen.below || seen.above || seen.behind)) return uvec2(0u);
  if (uniformSegments > 0) return packedUnits(ivec4(uniformSegments * kSegmentUnit));
#ifdef SIZE
  if (box.finite == 0u) {
    capped = true;
    return packedUnits(ivec4(mostSegments * kSegmentUnit));
  }
  if (isRectangle(shape)) return packedUnits(unitsOfSizes(rectangleSizes(first, degreeU(shape), degreeV(shape))));
  return packedUnits(unitsOfSizes(triangleSizes(first, degreeU(shape))) * ivec4(1, 1, 1, 0));
#else
  float eps = tolerance * max(commonDepth > 0.0 ? commonDepth : seen.least, nearest);
  if (strict != 0 && commonDepth <= 0.0) eps /= sqrt(1.0 + min(seen.offAxis, dot(rayScale, rayScale)));
#ifdef SCREEN
  eps = tolerancePx;
#endif
  if (box.finite == 0u) {
    capped = true;
    return packedUnits(ivec4(mostSegments * kSegmentUnit));
  }
#ifdef BOUNDS_MADE
  const vec3 second = box.second;
#else
  const vec3 second = secondBounds(first, shape, box, eps);
#endif
  if (isRectangle(shape)) {
    const vec2 segments =
        segmentsWithin(second.x, second.y, second.z, 8.0 * eps * box.weight, RULE, float(mostSegments));
    return packedUnits(ivec4(units(segments.x), units(segments.y), units(segments.x), units(segments.y)));
  }
  return packedUnits(triangleUnits(second, eps, degreeU(shape)));
#endif
}
#endif

void main() {
  const uint number = gl_GlobalInvocationID.x;
  if (number >= patchCount) return;
  const TessellatedPatch patch_ = patches[number];
  const uint shape = shapeOf(patch_);
  const int first = int(patch_.firstPoint);
#if defined(MAKE_BOUNDS) && defined(MOVING)
  bounds[number] = movingBounds(first, shape);
#elif defined(MAKE_BOUNDS)
  PatchBounds made = boxOf(first, pointCount(shape));
  if (made.finite != 0u) made.second = secondBounds(first, shape, made, 0.0);
  bounds[number] = made;
#else
  const uvec2 own = factorsOf(number, shape, first);
#ifdef COUNT_CAPPED
  ownFactors[number] = uvec2(capped ? 1u : 0u, 0u);
#else
  ownFactors[number] = own;
#endif
#endif
}
