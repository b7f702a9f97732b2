// SPDX-License-Identifier: BSD-3-Clause
// What the shader that shows a product is bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::viewer {
#endif

const uint kPresentProductUnit = 0u;
const uint kPresentReceiversUnit = 1u;
const uint kPresentNormalsUnit = 2u;
const uint kPresentPositionsUnit = 3u;
const uint kPresentAlbedosUnit = 4u;
const uint kPresentImage = 0u;

#ifdef __cplusplus
}  // namespace limen::viewer
#endif
