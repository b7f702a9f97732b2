// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "renderer/frame/frame.h"

namespace limen::techniques {

/// Passes over a surface beside the one that is shown, as shadow maps and passes for depth alone are: each
/// draws it from the same eye into depths of their own (SC-75).
class DepthPasses {
 public:
  /// `pass`: name of the technique's passes.
  DepthPasses(frame::Frame& frame, const std::string& pass);
  /// `draw` is given the number of the pass, from 0.
  void render(frame::Frame& frame, int count, const std::function<void(int)>& draw) const;

 private:
  std::string pass_;
  gl::Texture depth_;
  gl::Framebuffer framebuffer_;
};

}  // namespace limen::techniques
