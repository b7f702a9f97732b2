// SPDX-License-Identifier: BSD-3-Clause
#include "perception/thresholds/thresholds_gpu.h"

#include "perception/band_thresholds/band_threshold_gpu.h"
#include "perception/threshold_maps/threshold_map_gpu.h"

namespace limen::perception {

std::unique_ptr<ThresholdMaker> makeThresholds(gl::Context& context, glm::ivec2 sizePx,
                                               const DisplayProfile& display,
                                               const ThresholdGpuSettings& settings, bool colourInput) {
  if (const auto* single = std::get_if<SingleOnGpu>(&settings))
    return std::make_unique<ThresholdMapGpu>(context, sizePx, display, single->map, single->gpu, colourInput);
  return std::make_unique<BandThresholdGpu>(context, sizePx, display,
                                            std::get<BandThresholdSettings>(settings), colourInput);
}

}  // namespace limen::perception
