// SPDX-License-Identifier: BSD-3-Clause
// A picture of the light of each pixel's point, direct and indirect (see indirect_picture.h). The including shader defines
// indirectLight().
#include "renderer/techniques/global_illumination/indirect_point.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kIndirectPictureImage, rgba32f) uniform writeonly image2D picture;

// What the point reflects of other surfaces' light.
vec3 indirectLight(SurfacePoint point, vec3 albedo);

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  vec3 colour = vec3(0.0);
  SurfacePoint point;
  if (pixelSees(pixel, point)) {
    const vec3 albedo = reflectance(point);
    colour = directLight(point, albedo);
    if (withIndirect) colour += indirectLight(point, albedo);
    colour = unlessCutShort(colour);
  }
  imageStore(picture, pixel, vec4(colour, 1.0));
}
