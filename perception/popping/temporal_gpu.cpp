// SPDX-License-Identifier: BSD-3-Clause
#include "perception/popping/temporal_gpu.h"

#include "perception/popping/gpu/popping_bindings.h"

namespace limen::perception {

TemporalTablesGpu::TemporalTablesGpu(const PoppingModel& model, const DisplayProfile& display,
                                     const PoppingSettings& settings, const TemporalChannels& channels,
                                     const ResponseTableGrid& grid)
    : steady_(gl::Format::RGBA32F, responseTablePx(model, grid)),
      onset_(gl::Format::RGBA32F, responseTablePx(model, grid)),
      framesHeldS_(channels.holdShare / display.refreshHz) {
  const auto tables = temporalTables(model, display, settings, channels, grid);
  steady_.write(tables->steady);
  onset_.write(tables->onset);
}

void TemporalTablesGpu::bind(const gl::Program& program, double peakCpd) const {
  steady_.bindTexture(kResponseSteadyUnit);
  onset_.bindTexture(kResponseOnsetUnit);
  program.set("holdCyclesPerDegS", static_cast<float>(peakCpd * framesHeldS_));
}

}  // namespace limen::perception
