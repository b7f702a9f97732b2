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

// What a point reflects of other surfaces' light. All invocations of a group call it, so that it may have barriers; `there`: whether
// this one has a point.
vec3 indirectLight(bool there, SurfacePoint point, vec3 albedo);

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  const bool inPicture = all(lessThan(pixel, sizePx));
  const uint id = inPicture ? texelFetch(triangleIds, pixel, 0).x : kRayNoTriangle;
  const bool there = id != kRayNoTriangle;
  vec3 colour = vec3(0.0), albedo = vec3(0.0);
  SurfacePoint point = SurfacePoint(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), kRayNoTriangle);
  if (there) {
    SeenPoint seen;
    point = surfaceSeen(pixel, id, seen);
    albedo = reflectance(point);
    if (withDirect) colour += emitted(point) + albedo * lampRadiance(point);
  }
  if (withIndirect) colour += indirectLight(there, point, albedo);
  if (rayCutShort) colour = vec3(uintBitsToFloat(0x7fc00000u));
  if (inPicture) imageStore(picture, pixel, vec4(colour, 1.0));
}
