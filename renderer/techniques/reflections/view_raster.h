// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/frame/frame.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"

namespace limen::techniques {

/// Which triangle each pixel of any view sees, as frame::TriangleIds has it of the camera's: for views that
/// mirrors or reflectors need. Depth is reversed: the view's matrix gives near / distance.
class ViewRaster {
 public:
  static constexpr uint32_t kNoGroup = 0xffffffffU;
  enum class Shown {
    Nearest,
    BackFaces,         ///< the nearest triangle that turns its back to the view, by its winding
    FrontsBehindDepth  ///< the nearest behind a depth of those that turn their front to the view
  };
  /// `groups`: a number for each of the scene's triangles; draw() can leave out those of one number.
  /// `masked`: draw() draws only where a mask has a certain value.
  ViewRaster(frame::Frame& frame, glm::ivec2 sizePx, const std::vector<uint32_t>& groups, bool masked,
             Shown shown = Shown::Nearest);

  void clear() const;
  /// Draws the part of the scene where dot(clipPlane, (position, 1)) >= 0, relative to the anchor. `image`:
  /// of a masked view the mask, R32UI; behind a depth that depth, reversed, as depth() has it.
  void draw(const frame::Frame& frame, const glm::mat4& anchorToClip, glm::vec4 clipPlane, uint32_t leftOut,
            const gl::Texture* image = nullptr, uint32_t wanted = 0) const;
  /// R32UI; frame::TriangleIds::kNone: nothing.
  const gl::Texture& ids() const { return ids_; }
  /// Depth32F: near / distance, 0: nothing.
  const gl::Texture& depth() const { return depth_; }
  const gl::Buffer& groups() const { return groups_; }
  int64_t bytes() const { return ids_.bytes() + depth_.bytes() + groups_.bytes(); }

 private:
  const gl::Program& program_;
  gl::Texture ids_, depth_;
  gl::Framebuffer framebuffer_;
  gl::Buffer groups_;
};

}  // namespace limen::techniques
