// SPDX-License-Identifier: BSD-3-Clause
// What shaders of anti-aliasing are bound to. For C++ and GLSL. Storage buffers 0 to 5 belong to the scene, 6
// and 7 to the tree of its rays in shaders that trace; the shadow map has texture unit 2.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

const int kMostWindow = 4;  // samples along each axis
const int kMostWindowSamples = 16;

const uint kSampleIdsUnit = 0u;
const uint kSampleFirstUnit = 3u;   // colour of each pixel's first sample
const uint kSampleCountsUnit = 4u;  // samples of each pixel
const uint kSampleOutImage = 0u;
const uint kSampleCountsImage = 1u;

// Pixels sorted by their number of samples.
struct SampleSort {  // std430
  uint groupsX;      // of an indirect dispatch over the listed pixels, in groups of kSortedGroup
  uint groupsY;
  uint groupsZ;
  uint pixels;         // listed: those with more than one sample
  uint histogram[20];  // pixels with so many samples
  uint cursor[20];     // where the next one of them is listed
};
#ifdef __cplusplus
static_assert(sizeof(SampleSort) == 176 && offsetof(SampleSort, histogram) == 16);
#endif
const int kSortedGroup = 64;
const uint kSortedListBuffer = 6u;
const uint kSortedHeaderBuffer = 7u;

// Filters of finished pictures.
const uint kFilterColoursUnit = 0u;
const uint kFilterEdgesUnit = 1u;
const uint kFilterOutImage = 0u;
const uint kFilterEdgesImage = 1u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif
