// SPDX-License-Identifier: BSD-3-Clause
// Mean distance of the hits from each position of an object, for fields that store no others.
#include "renderer/visibility_fields/field_bindings.h"

layout(local_size_x = kFieldMakeGroup) in;
layout(std430, binding = kFieldMapsBuffer) buffer FieldMaps { vec4 fieldMaps[]; };
layout(std430, binding = kFieldSumsBuffer) readonly buffer Sums { vec2 sums[]; };
uniform int firstMap, mapCount, wordsPerMap;

void main() {
  const int map = int(gl_GlobalInvocationID.x);
  if (map >= mapCount) return;
  vec2 sum = vec2(0.0);
  for (int i = 0; i < wordsPerMap; ++i) sum += sums[map * wordsPerMap + i];
  fieldMaps[firstMap + map].w = sum.y > 0.0 ? sum.x / sum.y : 0.0;
}
