// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/incremental_voxels/clean_up.h"
#include "renderer/incremental_voxels/injection.h"
#include "renderer/incremental_voxels/moving_bricks.h"

namespace limen::techniques {

/// The two stages of a step: voxels are cleaned up, or all emptied if none are kept, and filled from samples.
class IncrementalUpdate {
 public:
  struct Settings {
    std::optional<incremental_voxels::CleanUpSettings> kept;  ///< none: voxels of the current frame alone
    incremental_voxels::PointSettings points;
    std::vector<glm::ivec2> tiledPx = {};  ///< as incremental_voxels::CleanUp has it
  };
  IncrementalUpdate(gl::Context& context, const Settings& settings,
                    const incremental_voxels::SampledVolume& volume, int views, int used);
  int64_t bytes() const { return cleanUp_ ? cleanUp_->bytes() : 0; }
  /// Opens a pass for each stage. `only`: bricks to clean up, which those of the frame's time join.
  void run(frame::Frame& frame, const incremental_voxels::SampledVolume& volume,
           const std::vector<incremental_voxels::DepthView>& views,
           const incremental_voxels::SampleLighting& lighting, int step,
           incremental_voxels::MovingBricks* only = nullptr) const;

 private:
  std::optional<incremental_voxels::CleanUp> cleanUp_;
  incremental_voxels::Injection injection_;
};

}  // namespace limen::techniques
