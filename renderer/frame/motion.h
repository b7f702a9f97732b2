// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/frame/frame.h"
#include "renderer/gl/texture.h"

namespace limen::frame {

struct MotionSetting {
  double dtS = 1.0 / 60.0;  ///< time since the previous frame, > 0
  std::string key() const;
};

/// Where the surface point of each pixel lay in the previous frame, the camera having moved along its path by
/// dt (Schwarz 2009, section 10.3.5), and parts as they do (scene/part_motion.h). What a mirror shows moves
/// with the mirror here.
class Motion : public FrameInput {
 public:
  static constexpr const char* kName = "motion";
  Motion(Frame& frame, MotionSetting setting);
  void make(Frame& frame) override;

  /// RG32F: position now minus position then, px, x to the right and y down: pixel centre + 0.5 minus this is
  /// where to look in the previous frame. Background pixels move like points at infinity. A point that lay
  /// beside or behind the previous eye has no such position: its motion is the image's diagonal, pointing
  /// away from the centre.
  const gl::Texture& displacement() const { return displacement_; }
  /// R32F: the point's distance along the previous view, to be compared with the previous frame's
  /// Channel::Depth; 0 for background, -1 for points that lay beside or behind the previous eye.
  const gl::Texture& previousDepth() const { return previousDepth_; }

 private:
  void setParts(const Frame& frame, const glm::dmat4& nowToThen) const;

  MotionSetting setting_;
  const gl::Program& program_;
  gl::Texture displacement_, previousDepth_;
};

}  // namespace limen::frame
