// SPDX-License-Identifier: BSD-3-Clause
#define FRAGMENT
#include "renderer/techniques/soft_shadows/bitmask/bitmask.comp.glsl"
#include "renderer/techniques/soft_shadows/shaded/loop_in_shading.glsl"
