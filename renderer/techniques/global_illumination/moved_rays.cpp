// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/global_illumination/moved_rays.h"

namespace limen::techniques {

MovedRays::MovedRays(frame::Frame& frame) {
  if (!frame.scene().motions.empty()) tree_.emplace(frame.context(), frame.gpuScene().triangleCount());
}

void MovedRays::build(frame::Frame& frame) const {
  if (tree_) tree_->build(frame.passes(), frame.positions(), frame.gpuScene().indices());
}

}  // namespace limen::techniques
