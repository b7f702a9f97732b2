// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/gl/buffer.h"

namespace limen::many_lods {

/// How a tree's nodes hang together, for those who walk it on the GPU.
struct TreeShape {
  int height = 0;                      ///< edges from the root to the farthest leaf
  const gl::Buffer* links = nullptr;   ///< TreeLink of each node; null: complete
  const gl::Buffer* travel = nullptr;  ///< TreeTravel; null: how far nodes move is not known
};

}  // namespace limen::many_lods
