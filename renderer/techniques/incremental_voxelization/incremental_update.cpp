// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/incremental_voxelization/incremental_update.h"

namespace limen::techniques {

IncrementalUpdate::IncrementalUpdate(gl::Context& context, const Settings& settings,
                                     const incremental_voxels::SampledVolume& volume, int views, int used)
    : injection_(context, settings.points, volume, views, used) {
  if (settings.kept) cleanUp_.emplace(context, *settings.kept, volume, views, used, settings.tiledPx);
}

void IncrementalUpdate::run(frame::Frame& frame, const incremental_voxels::SampledVolume& volume,
                            const std::vector<incremental_voxels::DepthView>& views,
                            const incremental_voxels::SampleLighting& lighting, int step,
                            incremental_voxels::MovingBricks* only) const {
  {
    const auto scope = frame.passes().open("incremental_voxelization/clean_up");
    const glm::dvec3 anchor = frame.gpuScene().anchor();
    if (!cleanUp_) {
      volume.clear();
    } else if (only) {
      cleanUp_->run(volume, views, anchor, only->list(), only->count());
      only->add(frame.timeS(), volume.wrap());
    } else {
      cleanUp_->run(volume, views, anchor);
    }
  }
  const auto scope = frame.passes().open("incremental_voxelization/inject");
  injection_.run(frame, volume, views, lighting, step);
}

}  // namespace limen::techniques
