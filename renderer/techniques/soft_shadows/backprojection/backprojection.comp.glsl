// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/shadow_lookup.glsl"
#include "renderer/techniques/soft_shadows/occluder_search.glsl"

float occludedArea = 0.0;

float frontShare = 1.0;  // of the light, that is before the receiver's plane

void clearGathered() { occludedArea = 0.0; }

#include "renderer/techniques/soft_shadows/plane_share.glsl"
void hideBehindPlane(vec4 p) { frontShare = shareBeforePlane(p); }
void accumulate(vec2 low, vec2 high) { occludedArea += (high.x - low.x) * (high.y - low.y); }

// Clamped in an order that turns a NaN into a bound.
vec2 clampToLight(vec2 s) { return min(max(s, vec2(0.0)), vec2(1.0)); }

// Both triangles' signed areas at once; along which diagonal they are cut does not matter. Clamping moves a corner the
// same way for all quads that share it, so that neither gaps nor overlaps arise.
void accumulateQuad(vec2 a, vec2 b, vec2 c, vec2 d) {
  const vec2 ac = clampToLight(c) - clampToLight(a), bd = clampToLight(d) - clampToLight(b);
  const float area = 0.5 * (ac.x * bd.y - ac.y * bd.x);
#ifdef SIGNED_AREAS
  occludedArea += area;
#else
  occludedArea += abs(area);
#endif
}

#if OCCLUDERS == OCCLUDERS_CONTOURS
// Area of the light to the left of an edge, up to the light's side x = 0 and signed: the integral of x clamped to the light
// along the edge's part with y on the light. Over a closed contour it adds up to the area within.
void accumulateEdge(vec2 from, vec2 to) {
  const float start = clamp(from.y, 0.0, 1.0), end = clamp(to.y, 0.0, 1.0);
  if (start == end) return;
  const float run = (to.x - from.x) / (to.y - from.y);
  const float startX = from.x + (start - from.y) * run, endX = from.x + (end - from.y) * run;
  const float low = min(startX, endX), high = max(startX, endX);
  const float lowIn = clamp(low, 0.0, 1.0), highIn = clamp(high, 0.0, 1.0);
  // Share of the way beyond x = 1, and within.
  float mean = 0.5 * (lowIn + highIn);
  if (high - low > 1e-6)
    mean = (max(high, 1.0) - max(low, 1.0) + (highIn - lowIn) * mean) / (high - low);
  occludedArea += (end - start) * mean;
}
#endif

#if LANES > 1
// Each invocation adds up the areas of its own micro-occluders, then all sums are added in the invocations' order. With n
// areas of the sum A, rounding differs from that of another order by less than 2^-23 n A.
shared float laneAreas[kWorkListGroup];
void joinLanes() {
  const uint own = gl_LocalInvocationIndex, first = own % kGroupPixels;
  laneAreas[own] = occludedArea;
  memoryBarrierShared();
  barrier();
  occludedArea = 0.0;
  for (uint lane = 0u; lane < LANES; ++lane) occludedArea += laneAreas[first + lane * kGroupPixels];
}
#endif

bool isSaturated() {
#if defined(SIGNED_AREAS) || OCCLUDERS == OCCLUDERS_CONTOURS
  return false;  // what is still to come may take away
#else
  return occludedArea >= 1.0;
#endif
}
// Areas cannot tell whether an occluder and the receiver's plane hide the same part: taken as independent.
float gatheredVisibility() { return frontShare * (1.0 - clamp(occludedArea, 0.0, 1.0)); }
