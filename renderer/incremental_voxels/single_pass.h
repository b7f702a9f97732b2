// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "renderer/incremental_voxels/clean_up.h"
#include "renderer/incremental_voxels/injection.h"

namespace limen::incremental_voxels {

/// Clean-up and injection in one, at voxels' middles instead of at an image's points: without holes within
/// what a view sees, its surfaces as thick as the bias has them. Source: Gaitatzes 2012, section 7.4.3.
class SinglePass {
 public:
  /// `tiledPx`: as CleanUp has it.
  SinglePass(gl::Context& context, const CleanUpSettings& settings, const SampledVolume& volume, int views,
             int used, const std::vector<glm::ivec2>& tiledPx = {});
  int64_t bytes() const { return tiles_ ? tiles_->bytes() : 0; }
  /// Opens no pass.
  void run(const frame::Frame& frame, const SampledVolume& volume, const std::vector<DepthView>& views,
           const SampleLighting& lighting) const;

 private:
  CleanUpSettings settings_;
  std::optional<DepthTiles> tiles_;
  const gl::Program& program_;
};

}  // namespace limen::incremental_voxels
