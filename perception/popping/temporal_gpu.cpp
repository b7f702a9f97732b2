// SPDX-License-Identifier: BSD-3-Clause
#include "perception/popping/temporal_gpu.h"

#include <algorithm>
#include <cmath>

#include "perception/metrics/row_sums.h"
#include "perception/popping/gpu/popping_bindings.h"

namespace limen::perception {

glm::ivec2 TemporalGrid::tablePx(const PoppingModel& model) const {
  return {size.x, size.y * std::max(1, model.contrastLevels)};
}

TemporalTablesGpu::TemporalTablesGpu(const PoppingModel& model, const DisplayProfile& display,
                                     const PoppingSettings& settings, const TemporalChannels& channels,
                                     const TemporalGrid& grid)
    : steady_(gl::Format::RGBA32F, grid.tablePx(model)),
      onset_(gl::Format::RGBA32F, grid.tablePx(model)),
      framesHeldS_(channels.holdShare / display.refreshHz) {
  const glm::ivec2 px = grid.tablePx(model);
  Image steady(px.x, px.y, 4), onset(px.x, px.y, 4);
  if (model.contrastLevels > 0) {
    const Sensitivity sensitivity(model, display, settings, true);
    const TemporalSensitivity temporal(model, display, settings, channels, sensitivity);
    forRowBlocks(px.y, static_cast<size_t>(px.x) * 1000, [&](int first, int end) {
      for (int y = first; y < end; ++y)
        for (int x = 0; x < px.x; ++x) {
          const TemporalGains gains = temporal.at(y / grid.size.y, std::exp2(grid.low.x + x / grid.per.x),
                                                  std::exp2(grid.low.y + y % grid.size.y / grid.per.y));
          for (int m = 0; m < 4; ++m) {
            steady.at(x, y, m) = static_cast<float>(gains[static_cast<size_t>(m)].steady);
            onset.at(x, y, m) = static_cast<float>(gains[static_cast<size_t>(m)].onset);
          }
        }
    });
  }
  steady_.write(steady);
  onset_.write(onset);
}

void TemporalTablesGpu::bind(const gl::Program& program, double peakCpd) const {
  steady_.bindTexture(kResponseSteadyUnit);
  onset_.bindTexture(kResponseOnsetUnit);
  program.set("holdCyclesPerDegS", static_cast<float>(peakCpd * framesHeldS_));
}

}  // namespace limen::perception
