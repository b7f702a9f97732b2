// SPDX-License-Identifier: BSD-3-Clause
// What shaders of ambient occlusion are bound to. For C++ and GLSL. Storage buffers 0, 1, 6 and 7 belong to
// the scene and to the tree of its rays in the shader that traces.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

const uint kOcclusionDepthUnit = 0u;
const uint kOcclusionNormalUnit = 1u;
const uint kOcclusionPositionUnit = 2u;
const uint kOcclusionIdsUnit = 3u;
const uint kOcclusionPackedUnit = 4u;  // occlusion, depth and normal of each pixel
const uint kOcclusionPackedImage = 0u;
const uint kOcclusionOutImage = 1u;

const uint kOcclusionCountsBuffer = 0u;  // kOcclusionSlots numbers of texels fetched
const int kOcclusionSlots = 64;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif
