// SPDX-License-Identifier: BSD-3-Clause
// How many points the geometry shader passed on.
#include "renderer/compute/reduction_items.glsl"

layout(local_size_x = 1) in;
layout(std430, binding = kReductionStateBuffer) readonly buffer State { uint generated; };

void main() { finishCount(generated); }
