// SPDX-License-Identifier: BSD-3-Clause
// Local light of each pixel, and what mirrors add to it. See reflection_picture.h.
#include "renderer/techniques/reflections/reflection_bindings.h"
#include "renderer/techniques/reflections/seen_share.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kReflectionOriginsUnit) uniform sampler2D origins;
layout(binding = kReflectionDirectionsUnit) uniform sampler2D directions;
layout(binding = kReflectionIdsUnit) uniform usampler2D triangleIds;
layout(binding = kComposeLocalUnit) uniform sampler2D local;
layout(binding = kComposeReflectedUnit) uniform sampler2D reflected;
layout(binding = kComposeImage, rgba32f) uniform writeonly image2D outImage;
uniform ivec2 sizePx;
uniform vec3 background;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  vec3 colour = texelFetch(local, pixel, 0).rgb;
  if (texelFetch(origins, pixel, 0).w > 0.0) {
    const SurfaceMaterial material = surfaceMaterials[surfaceMaterialOf[texelFetch(triangleIds, pixel, 0).x]];
    const vec4 found = texelFetch(reflected, pixel, 0);
    const vec3 share = firstShare(material, texelFetch(directions, pixel, 0).w);
    colour += share * (found.rgb + (1.0 - clamp(found.a, 0.0, 1.0)) * background);
  }
  imageStore(outImage, pixel, vec4(colour, 1.0));
}
