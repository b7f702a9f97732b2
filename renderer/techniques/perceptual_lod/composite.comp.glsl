// SPDX-License-Identifier: BSD-3-Clause
// The nearest surface of each pixel over all layers, and the nearest of another layer than that: together they
// give the composite of all layers and, for each layer, of all others. Adds up to five layers to what is there.
#include "renderer/techniques/perceptual_lod/perceptual_lod_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kCompositeColoursUnit) uniform sampler2D colours[kCompositeLayers];
layout(binding = kCompositeDepthsUnit) uniform sampler2D depths[kCompositeLayers];
layout(binding = kCompositeIdsUnit) uniform usampler2D triangleIds[kCompositeLayers];
layout(binding = kCompositeFrontColourImage, rgba32f) uniform image2D frontColour;
layout(binding = kCompositeFrontKeyImage, rgba32ui) uniform uimage2D frontKey;
layout(binding = kCompositeSecondColourImage, rgba32f) uniform image2D secondColour;
layout(binding = kCompositeSecondKeyImage, rgba32ui) uniform uimage2D secondKey;

uniform ivec2 sizePx;
uniform vec3 background;
uniform int layerCount, first;  // first: nothing is there yet
uniform int layerNumbers[kCompositeLayers];

#include "renderer/techniques/perceptual_lod/surface_key.glsl"

struct Surface {
  vec3 colour;
  Key key;
};

void add(Surface candidate, inout Surface front, inout Surface second) {
  if (candidate.key.depth == 0.0) return;
  if (isNearer(candidate.key, front.key)) {
    second = front;
    front = candidate;
  } else if (isNearer(candidate.key, second.key)) {
    second = candidate;
  }
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  Surface front = Surface(background, Key(0.0, kNoTriangle, kBackgroundLayer)), second = front;
  if (first == 0) {
    front = Surface(imageLoad(frontColour, pixel).rgb, unpackKey(imageLoad(frontKey, pixel)));
    second = Surface(imageLoad(secondColour, pixel).rgb, unpackKey(imageLoad(secondKey, pixel)));
  }
#define ADD(i)                                                                                              \
  if (i < layerCount)                                                                                       \
    add(Surface(texelFetch(colours[i], pixel, 0).rgb,                                                       \
                Key(texelFetch(depths[i], pixel, 0).x, texelFetch(triangleIds[i], pixel, 0).x,              \
                    uint(layerNumbers[i]))),                                                                \
        front, second);
  ADD(0) ADD(1) ADD(2) ADD(3) ADD(4)
  imageStore(frontColour, pixel, vec4(front.colour, 1.0));
  imageStore(frontKey, pixel, packKey(front.key));
  imageStore(secondColour, pixel, vec4(second.colour, 1.0));
  imageStore(secondKey, pixel, packKey(second.key));
}
