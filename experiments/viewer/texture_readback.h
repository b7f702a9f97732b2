// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "experiments/viewer/presenter.h"
#include "renderer/gl/texture.h"

namespace limen::viewer {

/// All channels of a texture's finest level at a pixel counted from the top left; of a smaller or larger
/// texture, the texel that lies there. Waits for the GPU. Empty for depth formats.
std::vector<double> valuesAt(const gl::Texture& texture, glm::ivec2 pixel, glm::ivec2 pictureSizePx);

/// Any texture as a picture: colours as an sRGB display shows them, single channels in "magma" up to
/// `white`, integers in one colour per value. Depth formats are not shown.
struct TexturePicture {
  ScreenPicture picture;
  double white = 0.0;  ///< value of the brightest colour; 0: the picture is not a map of values
};
TexturePicture texturePicture(const gl::Texture& texture);

}  // namespace limen::viewer
