// SPDX-License-Identifier: BSD-3-Clause
// What the passes after the gathering of masks are bound to; their masks stand in shadow_bindings.h. For C++
// and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

// Joining the masks of several maps.
const uint kJoinMasksReceiversUnit = 0u;
const uint kJoinMasksVisibilityImage = 0u;

// Filter of visibility.
const uint kVisibilityFilterReceiversUnit = 0u;
const uint kVisibilityFilterVisibilitiesUnit = 1u;
const uint kVisibilityFilterPositionsUnit = 2u;
const uint kVisibilityFilterNormalsUnit = 3u;
const uint kVisibilityFilterVisibilityImage = 0u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif
