// SPDX-License-Identifier: BSD-3-Clause
// What the shaders of the references are bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::references {
#endif

// Sampled light.
const uint kSampledLightReceiversUnit = 0u;
const uint kSampledLightNormalsUnit = 1u;
const uint kSampledLightDepthMapUnit = 2u;
const uint kSampledLightLitCountsImage = 0u;

// Its resolve.
const uint kSampledLightResolveReceiversUnit = 0u;
const uint kSampledLightResolveLitCountsImage = 0u;
const uint kSampledLightResolveVisibilityImage = 1u;

#ifdef __cplusplus
}  // namespace limen::references
#endif
