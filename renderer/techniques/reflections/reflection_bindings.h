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
const uint kViewImageUnit = 0u;  // mask, or depth to draw behind

// Planar mirrors: the ray of each pixel between two bounces.
const uint kPlanarOriginImage = 1u;
const uint kPlanarDirectionImage = 2u;
const uint kPlanarShareImage = 3u;
const uint kPlanarChainImage = 4u;

// Environment map, and what became of each pixel's ray in it.
const uint kEnvironmentIdsUnit = 0u;
const uint kEnvironmentCubeUnit = 3u;
const uint kEnvironmentFacesUnit = 4u;
const uint kEnvironmentSecondCubeUnit = 5u;
const uint kEnvironmentSecondFacesUnit = 6u;
const uint kEnvironmentMapFacesUnit = 7u;
const uint kEnvironmentFateImage = 1u;
const uint kEnvironmentNoRay = 0u;
const uint kEnvironmentMet = 1u;
const uint kEnvironmentMetBehindCrack = 2u;  // and slipped behind a border of the last layer before
const uint kEnvironmentCrack = 3u;           // met nothing after that
const uint kEnvironmentMissed = 4u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif
