// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/frame/frame.h"

namespace limen::techniques {

/// Which triangle each of a pixel's samples sees, by the driver's rasteriser. Like frame::TriangleIds with
/// several samples per pixel.
class MultisampleIds {
 public:
  /// Throws Error unless the driver has surfaces with exactly this many samples.
  MultisampleIds(frame::Frame& frame, int samples);
  ~MultisampleIds();
  MultisampleIds(const MultisampleIds&) = delete;
  MultisampleIds& operator=(const MultisampleIds&) = delete;

  /// Opens no pass.
  void draw(frame::Frame& frame) const;
  /// R32UI, multisampled.
  void bindTexture(uint32_t unit) const;
  /// Of each sample in the pixel, from its top left corner, 0..1.
  const std::vector<glm::vec2>& places() const { return places_; }
  int64_t bytes() const;  ///< of ids and depths

 private:
  const gl::Program& program_;
  glm::ivec2 sizePx_;
  uint32_t ids_ = 0, depth_ = 0, framebuffer_ = 0;
  std::vector<glm::vec2> places_;
};

}  // namespace limen::techniques
