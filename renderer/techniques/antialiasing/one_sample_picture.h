// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "renderer/techniques/antialiasing/sample_view.h"

namespace limen::techniques {

/// The picture without anti-aliasing that filters of finished pictures start from: RGBA32F, linear.
class OneSamplePicture {
 public:
  explicit OneSamplePicture(const SampleShading& settings) : settings_(settings) {}
  void prepare(frame::Frame& frame);
  void render(frame::Frame& frame);
  const gl::Texture& texture() const { return *picture_; }

 private:
  SampleShading settings_;
  std::optional<SampleView> view_;
  const gl::Program* program_ = nullptr;
  std::optional<gl::Texture> picture_;
};

}  // namespace limen::techniques
