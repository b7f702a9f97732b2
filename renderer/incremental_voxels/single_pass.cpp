// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/incremental_voxels/single_pass.h"

namespace limen::incremental_voxels {

SinglePass::SinglePass(gl::Context& context, const CleanUpSettings& settings, const SampledVolume& volume,
                       int views, int used, const std::vector<glm::ivec2>& tiledPx)
    : settings_(settings),
      program_(context.programs().compute("renderer/incremental_voxels/single_pass.comp.glsl",
                                          disproofDefines(settings, volume, views, used, !tiledPx.empty()))) {
  if (!tiledPx.empty()) tiles_.emplace(context, tiledPx);
}

void SinglePass::run(const frame::Frame& frame, const SampledVolume& volume,
                     const std::vector<DepthView>& views, const SampleLighting& lighting) const {
  if (tiles_) {
    tiles_->run(views);
    tiles_->bind();
  }
  volume.bind(program_);
  configureDisproof(program_, settings_, views, volume.grid(), frame.gpuScene().anchor());
  if (volume.hasAttributes()) configureSampleLights(program_, frame, lighting);
  const glm::ivec3 counts = brickCounts(volume.grid());
  dispatchBricks(program_, volume.grid(), counts.x * counts.y * counts.z);
}

}  // namespace limen::incremental_voxels
