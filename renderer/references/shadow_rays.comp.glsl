// SPDX-License-Identifier: BSD-3-Clause
// Shadow rays from receivers to points on a light: counts those that arrive. `lanes` neighbouring invocations share
// a receiver. See compute_tracer.h; which hits count is said in embree_scene.h.
#include "renderer/ray_tracing/trace.glsl"
#include "renderer/references/light_point.glsl"

layout(local_size_x = kShadowRayGroup) in;
layout(std430, binding = kShadowRayReceiversBuffer) readonly buffer Receivers { ShadowReceiver receivers[]; };
layout(std430, binding = kShadowRayCountsBuffer) buffer Counts { ShadowCounts counts[]; };

uniform uint lanes, firstReceiver, endReceiver, firstSample, endSample;

// Of the ray that is being traced.
dvec3 exactOrigin = dvec3(0.0LF), exactDirection = dvec3(0.0LF);

// Whether the triangle's plane holds the origin so clearly not that double precision would say the same: over twice
// the tolerance away, the rounding of the origin (less than one more) and of the product apart.
bool clearlyOffPlane(vec3 a, vec3 b, vec3 c) {
  const vec3 from = a - vec3(exactOrigin), ab = b - a, ac = c - a, n = cross(ab, ac);
  const float rounding = 1.9073486e-6 * length(ab) * length(ac) * length(from);  // 2^-19
  return abs(dot(n, from)) > rounding + 4.0 * float(light.planeTolerance) * length(n);
}

bool crosses(dvec3 a, dvec3 b, dvec3 c) {
  const double u = dot(exactDirection, cross(a, b)), v = dot(exactDirection, cross(b, c)),
               w = dot(exactDirection, cross(c, a));
  return (u >= 0.0LF && v >= 0.0LF && w >= 0.0LF) || (u <= 0.0LF && v <= 0.0LF && w <= 0.0LF);
}

bool rayHitCounts(Ray ray, RayHit hit, vec3 va, vec3 vb, vec3 vc) {
  const bool isNear = hit.t * length(ray.direction) < light.nearDistance;
  if (!isNear && clearlyOffPlane(va, vb, vc)) return true;
  const dvec3 a = dvec3(va) - exactOrigin, b = dvec3(vb) - exactOrigin, c = dvec3(vc) - exactOrigin;
  const dvec3 n = cross(b - a, c - a);
  const double toPlane = dot(n, a), tolerance = light.planeTolerance;
  if (!(toPlane * toPlane > tolerance * tolerance * dot(n, n))) return false;
  return !isNear || (toPlane * dot(n, exactDirection) > 0.0LF && crosses(a, b, c));
}

void main() {
  const uint lane = gl_LocalInvocationID.x;
  const uint index = firstReceiver + gl_WorkGroupID.x * (uint(kShadowRayGroup) / lanes) + lane / lanes;
  if (index >= endReceiver) return;
  const ShadowReceiver from = receivers[index];
  const dvec3 normal = dvec3(from.normalX, from.normalY, from.normalZ);
  const uvec2 bits = pixelBits(from.pixel);
  exactOrigin = dvec3(from.x, from.y, from.z);
  Ray ray;
  ray.origin = vec3(exactOrigin);
  ray.near = 0.0;
  ray.far = light.farEnd;
  ray.skipped = from.triangle;
  uint seen = 0u, rays = 0u;
  for (uint i = firstSample + lane % lanes; i < endSample; i += lanes) {
    rayIterations += 2 + int(light.outlineCount);
    exactDirection = lightPoint(bits, i) - exactOrigin;
    if (!(dot(normal, exactDirection) > 0.0LF)) continue;
    ++rays;
    ray.direction = vec3(exactDirection);
    if (!rayAnyHit(ray)) ++seen;
  }
  if (rays > 0u) atomicAdd(counts[index].rays, rays);
  if (seen > 0u) atomicAdd(counts[index].seen, seen);
  if (rayCutShort) atomicOr(counts[index].seen, kShadowRayCutShort);
}
