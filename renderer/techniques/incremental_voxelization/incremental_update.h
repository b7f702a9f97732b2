// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/voxels/clean_up.h"
#include "renderer/voxels/injection.h"
#include "renderer/voxels/moving_bricks.h"

namespace limen::techniques {

/// The two stages of a step: voxels are cleaned up, or all emptied if none are kept, and filled from samples.
class IncrementalUpdate {
 public:
  struct Settings {
    std::optional<voxels::CleanUpSettings> kept;  ///< none: voxels of the current frame alone
    voxels::PointSettings points;
    std::vector<glm::ivec2> tiledPx = {};  ///< as voxels::CleanUp has it
  };
  IncrementalUpdate(gl::Context& context, const Settings& settings, const voxels::SampledVolume& volume,
                    int views, int used);
  int64_t bytes() const { return cleanUp_ ? cleanUp_->bytes() : 0; }
  /// Opens a pass for each stage. `only`: bricks to clean up, which those of the frame's time join.
  void run(frame::Frame& frame, const voxels::SampledVolume& volume,
           const std::vector<voxels::DepthView>& views, const voxels::SampleLighting& lighting, int step,
           voxels::MovingBricks* only = nullptr) const;

 private:
  std::optional<voxels::CleanUp> cleanUp_;
  std::optional<voxels::Forget> forget_;
  voxels::Injection injection_;
};

}  // namespace limen::techniques
