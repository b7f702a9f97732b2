// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "experiments/base/image.h"
#include "renderer/scene/scene.h"

namespace limen::scene {

/// Reads an image file as radiance: three channels, linear, row by row from the top. Values stored as
/// integers are taken as sRGB (IEC 61966-2-1), floating-point ones as linear; what is transparent emits
/// nothing. Throws Error naming the file: as readImageFile(); a value that is negative or not finite; a
/// picture that is black.
Image readRadiance(const std::string& path);

/// Parts of a light that shows a picture, seen from the lit side with the light's y axis upwards: cells x
/// cells rectangles, each with the mean radiance of the picture within it, so that the light's mean radiance
/// is the picture's. Cells that emit nothing are left out.
std::vector<LightPart> pictureParts(const Image& radiance, int cells);

}  // namespace limen::scene
