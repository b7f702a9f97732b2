// SPDX-License-Identifier: BSD-3-Clause
// What the shader of coloured light is bound to; the masks stand in shadow_bindings.h. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

const uint kLightColoursReceiversUnit = 0u;
const uint kLightColoursColourImage = 0u;
const uint kLightColoursColourMasksBuffer = 1u;
const uint kLightColoursSharesBuffer = 2u;
const uint kLightColoursTableBuffer = 1u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif
