// SPDX-License-Identifier: BSD-3-Clause
// Flux of each layer of a field, a group each.
#include "renderer/techniques/global_illumination/illumination_bindings.h"

layout(local_size_x = kLightFluxGroup) in;
layout(binding = kPropagateFieldUnit) uniform sampler2DArray fields;  // see propagate.comp.glsl
layout(std430, binding = kLightFluxBuffer) writeonly buffer Sums { float layerSums[]; };
uniform int firstLayer;

shared float parts[kLightFluxGroup];

void main() {
  const ivec2 size = textureSize(fields, 0).xy;
  const int layer = int(gl_WorkGroupID.x), own = int(gl_LocalInvocationIndex);
  float sum = 0.0;
  for (int i = own; i < size.x * size.y; i += kLightFluxGroup)
    sum += texelFetch(fields, ivec3(i % size.x, i / size.x, firstLayer + layer), 0).x;
  parts[own] = sum;
  barrier();
  for (int reach = kLightFluxGroup / 2; reach > 0; reach /= 2) {
    if (own < reach) parts[own] += parts[own + reach];
    barrier();
  }
  if (own == 0) layerSums[layer] = parts[0];
}
