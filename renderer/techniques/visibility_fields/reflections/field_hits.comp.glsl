// SPDX-License-Identifier: BSD-3-Clause
// What the rays of a pixel's mirror meet by the objects' fields: distance, normal, albedo.
#include "renderer/techniques/visibility_fields/field_pass_bindings.h"
#include "renderer/techniques/visibility_fields/reflections/object_hits.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kLobeOriginsUnit) uniform sampler2D origins;
layout(binding = kLobeIdsUnit) uniform usampler2D triangleIds;
layout(binding = kLobeDirectionsUnit) uniform sampler2DArray directions;
layout(binding = kLobeHitsImage, rgba32ui) uniform writeonly uimage2DArray hits;
uniform ivec2 sizePx;
uniform int rayCount, selfOcclusion;
#include "renderer/techniques/visibility_fields/field_counts.glsl"

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const vec4 origin = texelFetch(origins, pixel, 0);
  if (origin.w > 0.0) {
    const uint own = objectOf[texelFetch(triangleIds, pixel, 0).x];
    const uint without = selfOcclusion == 0 ? own : kFieldNoObject;
    for (int i = 0; i < rayCount; ++i) {
      const vec4 ray = texelFetch(directions, ivec3(pixel, i), 0);
      if (ray.w == 0.0) continue;
      const ObjectHit hit = nearestObject(origin.xyz, ray.xyz, kFieldNoObject, without, own);
      imageStore(hits, ivec3(pixel, i),
                 uvec4(floatBitsToUint(hit.distance), fieldNormalCode(hit.normal, 16), hit.albedo, 0u));
    }
  }
  countLookUps(pixel);
}
