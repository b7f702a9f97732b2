// SPDX-License-Identifier: BSD-3-Clause
// A picture of the light of each pixel's point, direct and indirect (see indirect_picture.h). The including shader defines
// indirectLight().
#include "renderer/techniques/global_illumination/illumination_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kIndirectIdsUnit) uniform usampler2D triangleIds;
layout(binding = kIndirectPictureImage, rgba32f) uniform writeonly image2D picture;

uniform ivec2 sizePx;
uniform bool withDirect, withIndirect;
#include "renderer/techniques/global_illumination/surface_light.glsl"

// What the point reflects of other surfaces' light.
vec3 indirectLight(SurfacePoint point, vec3 albedo);

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const uint id = texelFetch(triangleIds, pixel, 0).x;
  vec3 colour = vec3(0.0);
  if (id != kRayNoTriangle) {
    SeenPoint seen;
    const SurfacePoint point = surfaceSeen(pixel, id, seen);
    const vec3 albedo = reflectance(point);
    if (withDirect) colour += emitted(point) + albedo * lampRadiance(point);
    if (withIndirect) colour += indirectLight(point, albedo);
    if (rayCutShort) colour = vec3(uintBitsToFloat(0x7fc00000u));
  }
  imageStore(picture, pixel, vec4(colour, 1.0));
}
