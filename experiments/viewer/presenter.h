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
/// Of values in [0, 1], 1 or 3 and more channels.
ScreenPicture screenPicture(const Image& displayCoded);

/// Makes pictures of products for the screen in the context where they are: what experiments/product.h makes
/// of images, without reading the floats. Keeps a view of its own for the scene's colours, so that it takes
/// no part in what is timed.
class Presenter {
 public:
  Presenter(gl::Context& context, const frame::SceneOnGpu& onGpu, glm::ivec2 sizePx);

  /// The camera moved, or whatever else decides what is seen.
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
