// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OpenImageIO/imageio.h>

#include <memory>
#include <string>

#include "experiments/base/image.h"

namespace limen::codec {

/// Opens an image and checks what its header states before memory is taken for it. `wish`: hints for the
/// reader. Throws Error naming the file.
std::unique_ptr<OIIO::ImageInput> openChecked(const std::string& path, const ImageLimits& limits,
                                              const OIIO::ImageSpec& wish = {});

/// The whole stored picture, all channels. Throws Error naming the file where anything of it is missing.
Image readPixels(OIIO::ImageInput& in, const OIIO::ImageSpec& spec, const std::string& path);

/// Words of a library in one line, cut where they are many.
std::string oneLine(std::string words);

}  // namespace limen::codec
