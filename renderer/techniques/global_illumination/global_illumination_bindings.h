// SPDX-License-Identifier: BSD-3-Clause
// What shaders of global illumination are bound to. For C++ and GLSL. Storage buffers 0 to 5 are the scene's
// and its surfaces', 6 and 7 those of the tree of rays.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

const uint kLightPathIdsUnit = 0u;
const uint kLightPathRadianceImage = 0u;
const uint kLightPathMomentsImage = 1u;  // per pixel: sums of its paths' means over channels and of their
                                         // squares, rays

#ifdef __cplusplus
}  // namespace limen::techniques
#endif
