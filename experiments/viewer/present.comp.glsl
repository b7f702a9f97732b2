// SPDX-License-Identifier: BSD-3-Clause
// What a person looks at: the scene's colour with the visibility, or that of each channel, applied, or a colour product itself;
// coded for an sRGB display. The same as experiments/product.h makes of images that were read back, without reading them.
#include "experiments/viewer/present_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kPresentProductUnit) uniform sampler2D product;
layout(binding = kPresentReceiversUnit) uniform sampler2D receivers;
layout(binding = kPresentNormalsUnit) uniform sampler2D normals;
layout(binding = kPresentPositionsUnit) uniform sampler2D positions;
layout(binding = kPresentAlbedosUnit) uniform sampler2D albedos;
layout(binding = kPresentImage, rgba8) uniform writeonly image2D outPicture;
uniform ivec2 sizePx;
uniform int isShare, isGrey;
uniform vec3 light;  // relative to the scene's anchor

float coded(float linear) {
  const float value = clamp(linear, 0.0, 1.0);
  return value <= 0.0031308 ? 12.92 * value : 1.055 * pow(value, 1.0 / 2.4) - 0.055;
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const vec4 value = texelFetch(product, pixel, 0);
  vec3 seen = isGrey != 0 ? value.rrr : value.rgb;
  if (any(isnan(seen)) || any(isinf(seen))) {
    imageStore(outPicture, pixel, vec4(0.0, 1.0, 0.0, 1.0));
    return;
  }
  if (isShare != 0) {
    vec3 shading = vec3(0.0);
    if (texelFetch(receivers, pixel, 0).w >= 0.0) {
      const vec3 toLight = light - texelFetch(positions, pixel, 0).xyz;
      const float cosine = dot(texelFetch(normals, pixel, 0).xyz, toLight / length(toLight));
      shading = texelFetch(albedos, pixel, 0).rgb * max(cosine, 0.0);
    }
    seen *= shading;
  }
  imageStore(outPicture, pixel, vec4(coded(seen.r), coded(seen.g), coded(seen.b), 1.0));
}
