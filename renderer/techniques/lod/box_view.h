// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "renderer/frame/frame.h"
#include "renderer/frame/shaded.h"
#include "renderer/gl/texture.h"

namespace limen::techniques {

/// A shaded picture of chosen levels with samples x samples samples per pixel, averaged over the pixel's
/// square (box filter). One sample per pixel costs no extra pass.
class BoxView {
 public:
  /// `name` distinguishes its passes from others of the same frame. Throws Error if the samples make an image
  /// larger than the driver's largest texture.
  BoxView(frame::Frame& parent, const std::string& name, frame::ShadedSetting shaded, int samples);

  /// Follows the parent's time.
  void setLevels(const scene::LodSelection& selection) { frame_->setLevels(selection); }
  frame::Frame& frame() { return *frame_; }
  void render() { renderAt(parent_.timeS()); }
  void renderAt(double timeS);
  const gl::Texture& texture() const { return *texture_; }  ///< RGBA32F; after render()

 private:
  frame::Frame& parent_;
  frame::ShadedSetting shaded_;
  int samples_;
  std::string pass_;
  std::unique_ptr<frame::Frame> frame_;
  const gl::Program* resolve_ = nullptr;
  std::optional<gl::Texture> resolved_;
  const gl::Texture* texture_ = nullptr;
};

/// The line `samples` in the table of a technique with a BoxView.
template <class S>
Binding<S> samplesBinding(int S::*member) {
  return {member, "samples", Range{1, 16}, "", "Samples per pixel along each axis, box filter"};
}
}  // namespace limen::techniques
