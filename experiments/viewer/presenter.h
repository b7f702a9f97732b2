// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "experiments/base/image.h"
#include "renderer/frame/frame.h"
#include "renderer/gl/texture.h"
#include "renderer/techniques/technique.h"

namespace limen::viewer {

/// A picture for the screen: display-coded, four bytes a pixel, from the top left.
struct ScreenPicture {
  glm::ivec2 sizePx{0};
  std::vector<uint8_t> rgba;
};
/// From values in [0, 1], 1 channel or at least 3.
ScreenPicture screenPicture(const Image& displayCoded);

/// Makes pictures of products for the screen in the context that holds them: the same as
/// experiments/product.h makes from images, without reading back floats. Has its own view for the scene's
/// colours, so that it does not affect timings.
class Presenter {
 public:
  Presenter(gl::Context& context, const frame::SceneOnGpu& onGpu, glm::ivec2 sizePx);

  /// The camera moved, or anything else that determines what is seen.
  void refresh() { fresh_ = false; }
  ScreenPicture picture(techniques::ProductKind kind, const gl::Texture& product);
  /// The view, for values at a pixel.
  frame::Frame& view();

 private:
  ScreenPicture shaded(bool isShare, const gl::Texture& product);

  gl::Context& context_;
  const frame::SceneOnGpu& onGpu_;
  glm::ivec2 sizePx_;
  frame::Frame frame_;
  gl::Texture picture_;
  bool fresh_ = false;
};

}  // namespace limen::viewer
