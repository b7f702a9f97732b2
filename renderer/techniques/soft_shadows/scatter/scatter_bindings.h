// SPDX-License-Identifier: BSD-3-Clause
// What the shaders of scattering are bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

// Scattering.
struct ScatterCosts {  // std430
  uint cutShort;       // caster texels that a software renderer would not have let finish
  uint casterTexels, splats;
};
#ifdef __cplusplus
static_assert(sizeof(ScatterCosts) == 12);
#endif
const uint kScatterCastersUnit = 0u;
const uint kScatterReceiversUnit = 1u;
const uint kScatterHiddenImage = 0u;
const uint kScatterCostsBuffer = 0u;

// Look-up.
const uint kScatterLookupSeenPointsUnit = 0u;
const uint kScatterLookupReceiversUnit = 1u;
const uint kScatterLookupIdsUnit = 2u;
const uint kScatterLookupHiddenUnit = 3u;
const uint kScatterLookupHiddenBySecondUnit = 4u;
const uint kScatterLookupVisibilityImage = 0u;
const uint kScatterLookupClassesImage = 1u;
const uint kScatterLookupReceiverBitsBuffer = 1u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif
