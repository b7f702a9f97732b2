// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/voxelization/slice_output.glsl"

void main() { writeFragment(); }
