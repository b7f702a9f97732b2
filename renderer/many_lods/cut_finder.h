// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "renderer/gl/buffer.h"

namespace limen::many_lods {

/// A way to find the cuts of one tree for many views, kept in a list. What MultiCut::update() says holds for
/// all of them.
class CutFinder {
 public:
  virtual ~CutFinder() = default;
  virtual void update(const gl::Buffer& nodes, const gl::Buffer& views, bool counting) = 0;
  virtual void restart() = 0;
  virtual const gl::Buffer& list() const = 0;     ///< uvec2 each: node, view
  virtual const gl::Buffer& control() const = 0;  ///< CutControl first
  virtual int64_t bytes() const = 0;
};

}  // namespace limen::many_lods
