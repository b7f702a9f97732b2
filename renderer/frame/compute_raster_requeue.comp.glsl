// SPDX-License-Identifier: BSD-3-Clause
// Empties the queue between the depth pass and the index pass of ComputeRaster.
layout(local_size_x = 1) in;
layout(std430, binding = 3) buffer Queue { uint queued; };

void main() { queued = 0u; }
