// SPDX-License-Identifier: BSD-3-Clause
// What the shaders of screen-space reflections are bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

// Units 0 to 2: rays and what pixels see, as in reflection_bindings.h.
const uint kScreenPictureUnit = 3u;
const uint kScreenDepthUnit = 4u;
const uint kScreenPyramidUnit = 5u;
const uint kScreenBehindDepthUnit = 6u;  // of back faces, or of the second layer
const uint kScreenSecondIdsUnit = 7u;
const uint kScreenFateImage = 1u;

// Pyramid of nearest depths: all levels above the picture itself in one dispatch. Groups of
// kScreenPyramidGroup x kScreenPyramidGroup invocations make a tile of 4 x 4 pixels each.
const int kScreenPyramidLevels = 6;
const int kScreenPyramidGroup = 16;
const uint kScreenPyramidDepthUnit = 0u;
const uint kScreenPyramid1Image = 0u;
const uint kScreenPyramid2Image = 1u;
const uint kScreenPyramid3Image = 2u;
const uint kScreenPyramid4Image = 3u;
const uint kScreenPyramid5Image = 4u;
const uint kScreenPyramid6Image = 5u;

// What became of a pixel's ray, in the lowest bits; above them the places that it was looked at.
const uint kScreenNoRay = 0u;
const uint kScreenMet = 1u;     // a surface of the picture
const uint kScreenFree = 2u;    // nothing at any distance, in front of all that the picture shows
const uint kScreenHidden = 3u;  // went behind a surface and met nothing after
const uint kScreenLeft = 4u;    // left the picture at a border, or towards the eye
const uint kScreenCut = 5u;     // the most steps were not enough
const uint kScreenFateBits = 3u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif
