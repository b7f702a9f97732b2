// SPDX-License-Identifier: BSD-3-Clause
// Mean visibility over a pixel's rays, their distances looked up in the objects' fields.
#include "renderer/techniques/visibility_fields/occlusion_rays.glsl"
#include "renderer/visibility_fields/field_lookup.glsl"

layout(binding = kFieldOutImage, rgba32f) uniform writeonly image2D outImage;
#ifdef COUNT
layout(std430, binding = kFieldCountsBuffer) buffer Counts { uint counts[]; };
#endif
uniform float slack;  // diameters

// No ray of the point's half space meets the object's sphere.
bool liesBehind(OcclusionPoint point, uint object) {
  const FieldObject of = fieldObjects[object];
  return dot(of.centre - point.origin, point.normal) <= -of.radius;
}

bool canOcclude(OcclusionPoint point, uint object) {
  return (selfOcclusion != 0 || object != point.object) && !liesBehind(point, object);
}

#if COMBINE == 0
float openShare(OcclusionPoint point) {
  float open = 0.0;
  for (int y = 0; y < raySide; ++y)
    for (int x = 0; x < raySide; ++x) {
      const vec3 direction = occlusionDirection(point, ivec2(x, y));
      float nearest = -1.0;
      for (uint object = 0u; object < fieldObjectCount; ++object) {
        if (!canOcclude(point, object)) continue;
        const float distance = fieldDistance(object, point.origin, direction, slack);
        if (distance >= 0.0 && (nearest < 0.0 || distance < nearest)) nearest = distance;
      }
      open += nearest < 0.0 ? 1.0 : visibilityAt(nearest);
    }
  return open / float(raySide * raySide);
}
#else
float openShareOf(OcclusionPoint point, uint object) {
  float open = 0.0;
  for (int y = 0; y < raySide; ++y)
    for (int x = 0; x < raySide; ++x) {
      const float distance = fieldDistance(object, point.origin, occlusionDirection(point, ivec2(x, y)), slack);
      open += distance < 0.0 ? 1.0 : visibilityAt(distance);
    }
  return open / float(raySide * raySide);
}

float openShare(OcclusionPoint point) {
  float open = 1.0;
  for (uint object = 0u; object < fieldObjectCount; ++object) {
    if (!canOcclude(point, object)) continue;
#if COMBINE == 1
    open *= openShareOf(point, object);
#else
    open -= 1.0 - openShareOf(point, object);
#endif
  }
  return max(open, 0.0);
}
#endif

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  OcclusionPoint point;
  const float open = occlusionPoint(pixel, point) ? openShare(point) : 1.0;
  imageStore(outImage, pixel, vec4(vec3(open), 1.0));
#ifdef COUNT
  atomicAdd(counts[(pixel.y * sizePx.x + pixel.x) % kFieldCountSlots], fieldLookUps);
#endif
}
