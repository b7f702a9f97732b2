// SPDX-License-Identifier: BSD-3-Clause
// The cones that leave the mirrors which pixels see (Roger 2008, section 5.2.2): a point on the axis, the radius there, the
// direction, and the growth of the radius per unit of distance. The radius at the mirror is the pixel's footprint, so that
// no apex is needed, which may be at infinity. The formulas are those of cone_geometry.h.
uniform ivec2 sizePx;
#include "renderer/frame/surface_point.glsl"
#include "renderer/techniques/reflections/cone_traced/cone_traced_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kConeRayOriginsUnit) uniform sampler2D rayOrigins;
layout(binding = kConeRayDirectionsUnit) uniform sampler2D rayDirections;
layout(binding = kConeIdsUnit) uniform usampler2D triangleIds;
layout(binding = kConeSolidAnglesUnit) uniform sampler2D solidAngles;  // of a quadrant's pixels
layout(binding = kConeOriginsImage, rgba32f) uniform writeonly image2D outOrigins;
layout(binding = kConeDirectionsImage, rgba32f) uniform writeonly image2D outDirections;
layout(binding = kConeShapesImage, rg32f) uniform writeonly image2D outShapes;

uniform float glossScale, widest;

// Half-angle of the cone of the pixel's solid angle.
float pixelHalfAngle(ivec2 pixel) {
  const float solidAngle = texelFetch(solidAngles, min(pixel, sizePx - 1 - pixel), 0).x;
  return 2.0 * asin(sqrt(clamp(solidAngle / (4.0 * 3.14159265), 0.0, 1.0)));
}

// Mean curvature at a point of a triangle, positive where it is convex on the viewer's side.
float meanCurvature(uint id, vec3 point) {
#ifdef NORMALS
  const uvec3 vertices = sceneTriangle(id);
  if (surfaceMaterials[surfaceMaterialOf[id]].surface == kSurfacePatch) return 0.0;
  const vec3 a = scenePosition(vertices.x), b = scenePosition(vertices.y), c = scenePosition(vertices.z);
  const vec3 n0 = surfaceNormal(vertices.x), n1 = surfaceNormal(vertices.y), n2 = surfaceNormal(vertices.z);
  // Scaled: products of a tiny triangle's edges would leave float's range.
  const vec3 reach = max(abs(b - a), abs(c - a));
  const float unit = 1.0 / max(reach.x, max(reach.y, reach.z));
  const vec3 alongU = (b - a) * unit, alongV = (c - a) * unit, normalU = n1 - n0, normalV = n2 - n0;
  const vec3 weights = barycentrics(a, b, c, point);
  const vec3 normal = weights.x * n0 + weights.y * n1 + weights.z * n2;
  const float divisor = 2.0 * length(normal) * dot(alongU, cross(alongV, normal));
  // Vertices without a normal, triangles without area.
  if (divisor == 0.0) return 0.0;
  const float found = (dot(normalU, cross(alongV, normal)) + dot(alongU, cross(normalV, normal))) / divisor * unit;
  // Asked outright: a compiler may turn a comparison round, and what was false for a NaN is true then.
  if (isnan(found) || isinf(found)) return 0.0;
  // That side of the stored normals which the viewer is on, by the triangle as in sidedNormal().
  return dot(cross(alongU, alongV), eye - point) < 0.0 ? -found : found;
#else
  return 0.0;
#endif
}

#ifdef EDGE_RAYS
struct PlaneRay {
  vec2 origin, direction;
  bool meets;
};

// A ray from `from` reflected at the circle curvature (x^2 + y^2) + 2 y = 0; lengths in units of the eye's distance.
PlaneRay atCircle(vec2 from, vec2 direction, float curvature) {
  PlaneRay none;
  none.meets = false;
  const float a = curvature, b = 2.0 * (curvature * dot(from, direction) + direction.y);
  const float c = curvature * dot(from, from) + 2.0 * from.y, discriminant = b * b - 4.0 * a * c;
  if (!(discriminant >= 0.0)) return none;
  const float root = sqrt(discriminant);
  const float along = b > 0.0 ? (-b - root) / (2.0 * a) : 2.0 * c / (root - b);
  if (!(along > 0.0)) return none;
  const vec2 point = from + along * direction;
  const vec2 normal = normalize(vec2(curvature * point.x, curvature * point.y + 1.0));
  if (!(dot(direction, normal) < 0.0)) return none;
  return PlaneRay(point, reflect(direction, normal), true);
}

vec2 turned(vec2 v, float angle) {
  const float c = cos(angle), s = sin(angle);
  return vec2(c * v.x - s * v.y, s * v.x + c * v.y);
}
#endif

// Half-angle of the reflected cone, below 0 if it converges; `missed`: an edge of the cone does not meet the circle.
float reflectedHalfAngle(float apart, float cosine, float curvature, float halfAngle, out bool missed) {
  missed = false;
  const float bend = 2.0 * curvature * apart / cosine;
#ifdef EDGE_RAYS
  // Where the sum over both edges is a small difference, floats know it from the paraxial form better.
  if (abs(bend) * halfAngle < 1e-3) return halfAngle * (1.0 + bend);
  const vec2 towardsEye = vec2(-sqrt(max(1.0 - cosine * cosine, 0.0)), cosine);
  const PlaneRay left = atCircle(towardsEye, turned(-towardsEye, -halfAngle), curvature * apart);
  const PlaneRay right = atCircle(towardsEye, turned(-towardsEye, halfAngle), curvature * apart);
  missed = !left.meets || !right.meets;
  if (!missed) {
    const vec2 p = left.direction, q = right.direction;
    const float angle = 0.5 * atan(q.x * p.y - q.y * p.x, dot(p, q));
    return bend < -1.0 ? -abs(angle) : abs(angle);
  }
  if (left.meets || right.meets) {
    // From the middle to the edge that meets, or to the ray that only touches, which is not turned at all.
    const vec2 edge = left.meets ? left.direction : right.direction, middle = vec2(-towardsEye.x, towardsEye.y);
    return max(abs(atan(edge.x * middle.y - edge.y * middle.x, dot(edge, middle))), 2.0 * asin(min(cosine, 1.0)));
  }
#endif
  return halfAngle * (1.0 + bend);
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const vec4 ray = texelFetch(rayOrigins, pixel, 0);
  vec4 origin = vec4(0.0), direction = vec4(0.0);
  vec2 shape = vec2(0.0);
  if (ray.w > 0.0) {
    const uint id = texelFetch(triangleIds, pixel, 0).x;
    const vec4 mirrored = texelFetch(rayDirections, pixel, 0);
    const float apart = length(eye - ray.xyz), halfAngle = pixelHalfAngle(pixel);
    const float gloss = glossScale * surfaceMaterials[surfaceMaterialOf[id]].glossRad;
    bool missed;
    const float found = reflectedHalfAngle(apart, max(mirrored.w, 1e-4), meanCurvature(id, ray.xyz), halfAngle, missed);
    const float reflected = isnan(found) || isinf(found) ? halfAngle : abs(found);
    float whole = reflected + gloss;
    const bool clamped = isnan(whole) || whole >= widest;
    if (clamped) whole = widest;
    origin = vec4(ray.xyz, apart * tan(halfAngle));
    direction = vec4(mirrored.xyz, tan(whole));
    shape = vec2(clamped ? clamp(1.0 - gloss / widest, 0.0, 1.0) : reflected / max(whole, 1e-30),
                 float(clamped || missed ? kConeClamped : found > 0.0 ? kConeDiverging : kConeConverging));
  }
  imageStore(outOrigins, pixel, origin);
  imageStore(outDirections, pixel, direction);
  imageStore(outShapes, pixel, vec4(shape, 0.0, 0.0));
}
