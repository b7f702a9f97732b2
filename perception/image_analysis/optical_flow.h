// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/base/image.h"

namespace limen::perception {

/// How far each pixel of `now` has moved since `before`: 2 channels (x to the right, y down), pixels. The
/// images are pixel values in [0, 1] of the same size, 1 or 3 channels. An estimate from the pictures alone:
/// dense inverse search (Kroeger et al. 2016) of OpenCV, medium preset, on luma, in one thread so that the
/// machine's number of cores does not matter. Where nothing has structure it continues its surroundings;
/// beyond the picture's edge, behind what moves and on what changes its look it guesses.
Image opticalFlow(const Image& before, const Image& now);

}  // namespace limen::perception
