// SPDX-License-Identifier: BSD-3-Clause
// Empties the queue between the depth pass and the index pass of ComputeRaster.
#include "renderer/frame/frame_bindings.h"

layout(local_size_x = 1) in;
layout(std430, binding = kRasterQueueBuffer) buffer Queue { RasterQueueHeader queue; };

void main() { queue.queued = 0u; }
