// SPDX-License-Identifier: BSD-3-Clause
#define TRIANGLE_FROM_DRAW
#include "renderer/techniques/voxelization/slice_output.glsl"

void main() { writeFragment(); }
