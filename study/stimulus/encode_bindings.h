// SPDX-License-Identifier: BSD-3-Clause
// What the shader that encodes a stimulus is bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::study {
#endif

const uint kEncodePictureUnit = 0u;
const uint kEncodeUnlitUnit = 1u;
const uint kEncodeVisibilityUnit = 2u;
const uint kEncodeThresholdsUnit = 3u;
const uint kEncodeImage = 0u;

#ifdef __cplusplus
}  // namespace limen::study
#endif
