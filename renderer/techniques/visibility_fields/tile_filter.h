// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"
#include "renderer/techniques/visibility_fields/receiver_rays.h"

namespace limen::techniques {

/// Brings together what interleaved pixels found with different rays: means over windows that hold every
/// place of a tile once, of pixels that show the same surface by normals and positions. A plane without edges
/// gets what all rays of the tile's grid would give each pixel. Does nothing where none is asked for.
class TileFilter {
 public:
  TileFilter(const ReceiverRays& rays, std::string pass, gl::Format format)
      : rays_(rays), pass_(std::move(pass) + "/filter"), format_(format) {}

  void prepare(frame::Frame& frame);
  /// `raw`: of the frame's size and the format. For R32F pixels without Receivers are left out.
  void run(frame::Frame& frame, const gl::Texture& raw);
  /// `raw` itself without a filter.
  const gl::Texture& product(const gl::Texture& raw) const { return filtered_ ? *filtered_ : raw; }

 private:
  const BilateralFilter* bilateral() const;  ///< null: none is asked for

  ReceiverRays rays_;
  std::string pass_;
  gl::Format format_;
  const gl::Program* program_ = nullptr;
  std::optional<gl::Texture> filtered_;
};

}  // namespace limen::techniques
