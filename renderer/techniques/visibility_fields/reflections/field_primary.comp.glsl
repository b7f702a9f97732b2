// SPDX-License-Identifier: BSD-3-Clause
// Mirrored rays of pixels whose mirror has a field, from where the field has the view meet it, with its normal: what happens
// if fields serve the rays from the eye as well. Other mirrors keep their rays.
#include "renderer/techniques/visibility_fields/field_pass_bindings.h"
#include "renderer/techniques/visibility_fields/reflections/object_hits.glsl"
#include "renderer/frame/mirrored.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kLobeOriginsUnit) uniform sampler2D origins;
layout(binding = kLobeMirroredUnit) uniform sampler2D mirroredRays;
layout(binding = kLobeIdsUnit) uniform usampler2D triangleIds;
layout(binding = kLobeOriginsImage, rgba32f) uniform writeonly image2D outOrigins;
layout(binding = kLobeMirroredImage, rgba32f) uniform writeonly image2D outMirrored;
layout(binding = kLobeNormalsImage, rgba32f) uniform writeonly image2D outNormals;
uniform ivec2 sizePx;
uniform vec3 eyePosition;  // relative to the anchor

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  vec4 origin = texelFetch(origins, pixel, 0), ray = texelFetch(mirroredRays, pixel, 0), normal = vec4(0.0);
  if (origin.w > 0.0) {
    const uint own = objectOf[texelFetch(triangleIds, pixel, 0).x];
    if (own != kFieldNoObject) {
      const vec3 direction = normalize(origin.xyz - eyePosition);
      const ObjectHit hit = nearestObject(eyePosition, direction, own, kFieldNoObject, kFieldNoObject);
      if (hit.distance < 0.0) {
        origin = vec4(0.0);
      } else {
        normal = vec4(hit.normal, 1.0);
        origin = vec4(eyePosition + hit.distance * direction, 1.0);
        ray = vec4(mirrored(-direction, hit.normal, hit.normal), clamp(-dot(direction, hit.normal), 0.0, 1.0));
      }
    }
  }
  imageStore(outOrigins, pixel, origin);
  imageStore(outMirrored, pixel, ray);
  imageStore(outNormals, pixel, normal);
}
