// SPDX-License-Identifier: BSD-3-Clause
// What the shaders of global illumination are bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

// Paths.
const uint kPathIdsUnit = 0u;
const uint kPathSumsImage = 0u;
const uint kPathSumsUnit = 0u;
const uint kPathPictureImage = 0u;

// Light in voxels. Fields are arrays of 3 channels of as many layers as the grid has. Units 12 to 14 are the volume's.
const float kInjectFixed = 65536.0f;  // units of a sum of lobes: signed 32 bits hold intensities up to 32768
const uint kInjectSamplesUnit = 0u;
const uint kInjectSumsImage = 0u;
const int kPropagateGroup = 4;
const uint kPropagateFieldUnit = 0u;
const uint kPropagateOutImage = 1u;
const uint kPropagateGatheredImage = 2u;
const uint kReconstructIdsUnit = 0u;
const uint kReconstructGatheredUnit = 1u;
const uint kReconstructOutImage = 0u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif
