// SPDX-License-Identifier: BSD-3-Clause
// Given rays against one object by its field.
#include "renderer/ray_tracing/ray_tracing_bindings.h"
#include "renderer/visibility_fields/field_lookup.glsl"

layout(local_size_x = kFieldBatchGroup) in;
layout(std430, binding = kFieldBatchRaysBuffer) readonly buffer Rays { BatchRay rays[]; };
layout(std430, binding = kFieldBatchDistancesBuffer) writeonly buffer Distances { float distances[]; };
uniform uint object, firstRay, rayCount;
uniform float slack;

void main() {
  const uint index = firstRay + gl_GlobalInvocationID.x;
  if (index >= rayCount) return;
  distances[index] = fieldDistance(object, rays[index].origin, rays[index].direction, slack);
}
