// SPDX-License-Identifier: BSD-3-Clause
// What shaders of reflections are bound to. For C++ and GLSL. Storage buffers 0 to 7 belong to the scene and
// to its tree.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

// Rays from the mirrors that pixels see (MirrorRays), and what they bring.
const uint kReflectionOriginsUnit = 0u;
const uint kReflectionDirectionsUnit = 1u;
const uint kReflectionIdsUnit = 2u;
const uint kReflectionImage = 0u;

// Composition.
const uint kComposeLocalUnit = 3u;
const uint kComposeReflectedUnit = 4u;
const uint kComposeImage = 1u;

// Views of mirrors and reflectors (ViewRaster).
const uint kViewGroupsBuffer = 6u;
const uint kViewMaskUnit = 0u;

// Planar mirrors: the ray of each pixel between two bounces.
const uint kPlanarOriginImage = 1u;
const uint kPlanarDirectionImage = 2u;
const uint kPlanarShareImage = 3u;
const uint kPlanarChainImage = 4u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif
