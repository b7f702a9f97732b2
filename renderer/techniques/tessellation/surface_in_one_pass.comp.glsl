// SPDX-License-Identifier: BSD-3-Clause
// Colour of each pixel from what two rasters have gathered in the same pixels, the scene's own triangles and listed ones of curved
// surfaces (kSharedRasterTag), and clears it for the next frame: surface_resolve and surface_shade at once. SURFACES_ALONE: there are but listed ones, whose numbers
// have no tag. See surface_picture.h.
#include "renderer/techniques/tessellation/tessellation_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(std430, binding = kPictureGatheredBuffer) buffer Gathered { uvec2 gathered[]; };  // complement of the index, depth
layout(binding = kSurfacePictureImage, rgba32f) uniform writeonly image2D picture;

uniform ivec2 sizePx;
uniform uint firstQueue, secondQueue;  // of the two rasters, in `gathered`
#include "renderer/frame/shading.glsl"
#include "renderer/techniques/tessellation/surface_colour.glsl"
#define LISTED_VERTICES_BUFFER kPictureVerticesBuffer
#define LISTED_INDICES_BUFFER kPictureIndicesBuffer
#include "renderer/techniques/tessellation/listed_surface.glsl"

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (pixel == ivec2(0)) {
    gathered[firstQueue] = uvec2(0u);
    gathered[secondQueue] = uvec2(0u);
  }
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const int at = pixel.y * sizePx.x + pixel.x;
  const uvec2 found = gathered[at];
  gathered[at] = uvec2(0u);
  const uint id = ~found.x;
  vec3 colour;
#ifdef SURFACES_ALONE
  const bool isSurface = id != 0xffffffffu;
#else
  const bool isSurface = id != 0xffffffffu && (id & kSharedRasterTag) != 0u;
#endif
  if (!isSurface) {
    colour = shadedColour(pixel, id);
  } else {
    const ListedPoint seen = listedPoint(pixel, id & ~kSharedRasterTag);
    colour = surfaceColour(pixel, vec4(seen.normal, seen.depth), seen.material);
  }
  imageStore(picture, pixel, vec4(colour, 1.0));
}
