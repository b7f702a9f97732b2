// SPDX-License-Identifier: BSD-3-Clause
// Colour of each pixel from the triangle or the curved surface that it sees. See surface_picture.h.
#include "renderer/techniques/tessellation/tessellation_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kSurfaceIdsUnit) uniform usampler2D ids;
layout(binding = kSurfaceNormalsUnit) uniform sampler2D normals;  // and distance along the view
layout(binding = kSurfacePictureImage, rgba32f) uniform writeonly image2D picture;

uniform ivec2 sizePx;
#include "renderer/frame/shading.glsl"

#ifdef LIT
float sunShare(ivec2 pixel, SeenPoint seen) { return 1.0; }
#endif

vec3 surfaceColour(ivec2 pixel, uint id) {
  const float share = (id & kSurfaceDarkCheck) != 0u ? 0.4 : 1.0;
  const vec4 found = texelFetch(normals, pixel, 0);
  const vec3 position = (cameraToAnchor * vec4(pixelRay(pixel, rayScale, sizePx) * found.w, 1.0)).xyz;
  const vec3 towardsEye = eye - position;
  const vec3 view = dot(towardsEye, towardsEye) > 0.0 ? normalize(towardsEye) : vec3(0.0, 1.0, 0.0);
  vec3 normal = found.xyz;
  normal = dot(normal, normal) > 0.0 ? normalize(normal) : view;
  const SurfaceMaterial material = surfaceMaterials[id & ~(kSurfaceOfPatch | kSurfaceDarkCheck)];
  return litColour(share * patterned(material, position), normal, towardsLight(position, normal), view, 1.0, 1.0);
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const uint id = texelFetch(ids, pixel, 0).x;
  const vec3 colour = id == 0xffffffffu || (id & kSurfaceOfPatch) == 0u ? shadedColour(pixel, id)
                                                                      : surfaceColour(pixel, id);
  imageStore(picture, pixel, vec4(colour, 1.0));
}
