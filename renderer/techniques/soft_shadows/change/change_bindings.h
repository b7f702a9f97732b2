// SPDX-License-Identifier: BSD-3-Clause
// What the shader of the change is bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

const uint kChangeVisibilityBeforeUnit = 0u;
const uint kChangeVisibilityAfterUnit = 1u;
const uint kChangeReceiversBeforeUnit = 2u;
const uint kChangeReceiversAfterUnit = 3u;
const uint kChangeImage = 0u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif
