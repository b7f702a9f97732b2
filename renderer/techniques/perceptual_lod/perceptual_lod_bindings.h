// SPDX-License-Identifier: BSD-3-Clause
// What the shaders of perceptual levels of detail are bound to. For C++ and GLSL.
#pragma once

#include "renderer/frame/raster_regions.h"
#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
using glm::ivec2;
#endif

const int kLayerSlots = 9;  // layer 0 is the background
const int kMostTests = 16;

// Regions of a frame: of the shadow map, then of the picture. Each has the layers, without the objects under
// test in the shadow map, then versions of those objects.
const int kFirstLightVersion = kLayerSlots;
const int kFirstCameraRegion = kLayerSlots + 3 * kMostTests;
const int kFirstCameraVersion = kFirstCameraRegion + kLayerSlots;

// An object under test.
struct PlannedTest {  // std140
  int layer;
  int lightCurrent, lightFinest, lightNext;  // regions; -1: there is none
  int cameraFinest, cameraNext;       // finest: -1 if it is the current level; next: -1 if it is not tried
  uint firstTriangle, triangleCount;  // of the current level
  ivec2 low, high;                    // all pixels that it may cover
};
#ifdef __cplusplus
static_assert(sizeof(PlannedTest) == 48 && offsetof(PlannedTest, low) == 32);
static_assert(kFirstCameraVersion + 2 * kMostTests <= frame::kMostRasterRegions);
#endif

// All shaders that read the regions; 0 to 7 are the scene's buffers.
const uint kPlannedTestsBlock = 2u;
const uint kGatheredBuffer = 8u;
const int kClearGroup = 256;

// Composition.
const uint kComposePictureImage = 0u;
const uint kComposeBehindImage = 1u;
const uint kComposeContextImage = 2u;

// A layer on its own.
const uint kLayerViewImage = 0u;
const uint kLayerViewMaskImage = 1u;

// Test of a level.
const uint kLevelTestPictureUnit = 0u;
const uint kLevelTestBehindUnit = 1u;
const uint kLevelTestThresholdUnit = 2u;
const uint kLevelTestCountsBuffer = 9u;
const uint kLevelTestVisibleImage = 0u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif
