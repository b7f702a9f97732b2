// SPDX-License-Identifier: BSD-3-Clause
// Virtual point lights and their views. See virtual_lights.h.
#include "renderer/frame/frame_bindings.h"
#include "renderer/many_lods/many_lods_bindings.h"
#include "renderer/ray_tracing/trace.glsl"
#include "renderer/techniques/many_lods/many_lods_pass_bindings.h"

layout(local_size_x = kVirtualLightsGroup) in;
layout(std430, binding = kSurfaceTriangleMaterialsBuffer) readonly buffer TriangleMaterials { uint surfaceMaterialOf[]; };
layout(std430, binding = kSurfaceMaterialsBuffer) readonly buffer Materials { SurfaceMaterial surfaceMaterials[]; };
layout(std430, binding = kVirtualLightsBuffer) writeonly buffer Lights { VirtualLight lights[]; };
layout(std430, binding = kVirtualViewsBuffer) writeonly buffer Views { CutView views[]; };

uniform vec3 lightCentre, lightX, lightY, lightZ, fluxOfRay;
uniform uint lightCount;
uniform float lift, sizeFactor, inverseRange;

// Of the last hit that counted, which is the closest.
vec3 hitWinding = vec3(0.0);

bool rayHitCounts(Ray ray, RayHit hit, vec3 a, vec3 b, vec3 c) {
  hitWinding = cross(b - a, c - a);
  return true;
}

void main() {
  const uint index = gl_GlobalInvocationID.x;
  if (index >= lightCount) return;
  // R2 over the disc whose points are the feet of directions with the density of their cosine.
  const vec2 at = fract(0.5 + float(index) * vec2(0.75487767, 0.56984029));
  const float radius = sqrt(at.x), turn = 6.2831853 * at.y;
  const vec3 direction = normalize(lightX * (radius * cos(turn)) + lightY * (radius * sin(turn)) + lightZ * sqrt(max(1.0 - at.x, 0.0)));
  const RayHit hit = rayClosestHit(Ray(lightCentre, direction, 0.0, kRayFarthest, kRayNoTriangle));
  VirtualLight light = VirtualLight(vec4(0.0), vec4(0.0, 0.0, 1.0, 0.0), vec4(0.0));
  // Where there is no light, a view from far outside into the distance, whose cut is the root.
  CutView view;
  view.eye = vec4(0.0, 0.0, 1e6 / inverseRange, sizeFactor);
  vec3 normal = vec3(0.0, 0.0, 1.0);
  if (hit.triangle != kRayNoTriangle && !rayCutShort) {
    const float reach = max(abs(hitWinding.x), max(abs(hitWinding.y), abs(hitWinding.z)));
    normal = reach > 0.0 ? normalize(hitWinding / reach) : -direction;
    if (dot(normal, direction) > 0.0) normal = -normal;
    const vec3 position = lightCentre + hit.t * direction;
    light.position = vec4(position, kLightPoint);
    light.normal = vec4(normal, uintBitsToFloat(hit.triangle));
    light.flux = vec4(fluxOfRay * surfaceMaterials[surfaceMaterialOf[hit.triangle]].albedo, 0.0);
    view.eye.xyz = position + lift * normal;
  }
  const vec3 side = normalize(cross(normal, abs(normal.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0)));
  view.axisX = vec4(side, 1.0);
  view.axisY = vec4(cross(normal, side), 1.0);
  view.axisZ = vec4(normal, float(kViewHemisphere));
  view.frustum = vec4(1.0, 1.0, inverseRange, 0.0);
  lights[index] = light;
  views[index] = view;
}
