// SPDX-License-Identifier: BSD-3-Clause
// The environment map behind what vertices show, along the mirrored rays of a reflector's pixels (Roger 2008, section 2.4).
#include "renderer/techniques/reflections/vertex_reflection/vertex_reflection_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kReflectorIdsUnit) uniform usampler2D seenTriangles;
layout(binding = kFarDirectionsUnit) uniform sampler2D directions;
layout(binding = kFarEnvironmentUnit) uniform samplerCube environment;
layout(binding = kFarImage, rgba32f) uniform image2D reflected;
uniform ivec2 sizePx;
uniform uint reflectorFirst, reflectorCount;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const uint id = texelFetch(seenTriangles, pixel, 0).x;
  if (id < reflectorFirst || id - reflectorFirst >= reflectorCount) return;
  const vec4 near = imageLoad(reflected, pixel);
  if (near.a >= 1.0) return;
  const vec3 direction = texelFetch(directions, pixel, 0).xyz;
  // No direction: a driver may read anywhere.
  if (any(isnan(direction)) || any(isinf(direction)) || direction == vec3(0.0)) return;
  const vec4 far = textureLod(environment, direction, 0.0);
  // Both are multiplied by their alpha.
  imageStore(reflected, pixel, near + (1.0 - near.a) * far);
}
