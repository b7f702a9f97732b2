// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "perception/popping/regions.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/gl/pass_list.h"
#include "renderer/gl/texture.h"

namespace limen::perception {

/// Popping regions on the GPU: connected components by union-find in tiles of 32 x 32, merged over the tiles'
/// edges, with sums in fixed point, so that the same map gives the same bytes. Labels as in findRegions().
/// Allocates everything once; run() reads nothing back.
class RegionsGpu {
 public:
  RegionsGpu(gl::Context& context, glm::ivec2 sizePx, const PoppingSettings& settings);

  /// `jnd`: R32F, finite; `seeds`: R8UI, not 0 where a region may start. With `passes`, each step opens its
  /// own.
  void run(const gl::Texture& jnd, const gl::Texture& seeds, gl::PassList* passes = nullptr);

  /// R32UI, label by pixel.
  const gl::Texture& labels() const { return labels_; }
  /// Count and records of the regions, in the layout of region_table.glsl. Has room for the largest possible
  /// number.
  const gl::Buffer& table() const { return table_; }
  /// Regions of the last run. Waits for the GPU.
  RegionMap read() const;
  int64_t bytesHeld() const;

 private:
  gl::Context& context_;
  glm::ivec2 sizePx_;
  PoppingSettings settings_;
  gl::ShaderDefines defines_;
  gl::Texture labels_;
  gl::Buffer parents_, roots_, table_, chunks_;
};

}  // namespace limen::perception
