// SPDX-License-Identifier: BSD-3-Clause
// Colour of each pixel from the triangle or the curved surface that it sees. See surface_picture.h.
#include "renderer/techniques/tessellation/tessellation_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kSurfaceIdsUnit) uniform usampler2D ids;
layout(binding = kSurfaceNormalsUnit) uniform sampler2D normals;  // and distance along the view
layout(binding = kSurfacePictureImage, rgba32f) uniform writeonly image2D picture;

uniform ivec2 sizePx;
#include "renderer/frame/shading.glsl"

#include "renderer/techniques/tessellation/surface_colour.glsl"

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const uint id = texelFetch(ids, pixel, 0).x;
  const vec3 colour = id == 0xffffffffu || (id & kSurfaceOfPatch) == 0u ? shadedColour(pixel, id)
                                                                      : surfaceColour(pixel, texelFetch(normals, pixel, 0), id & ~kSurfaceOfPatch);
  imageStore(picture, pixel, vec4(colour, 1.0));
}
