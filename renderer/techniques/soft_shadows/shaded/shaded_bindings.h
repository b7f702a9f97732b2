// SPDX-License-Identifier: BSD-3-Clause
// What the shading passes of soft_shadows/shaded are bound to beside shading.glsl's storage; the loop's own
// bindings are in shadow_bindings.h, whose units for receivers and visibility are free here. For C++ and
// GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

const uint kShadeIdsUnit = 0u;
const uint kShadeImage = 0u;

// Of visibility that other passes have found.
const uint kShadeReceiversUnit = 1u;
const uint kShadeVisibilityUnit = 2u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif
