// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "perception/popping/response_tables.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"

namespace limen::perception {

/// Gains of TemporalSensitivity for the GPU's predictor (gpu/temporal.glsl).
class TemporalTablesGpu {
 public:
  /// Levels lie one below the other, as in the predictor's table of sensitivities.
  TemporalTablesGpu(const PoppingModel& model, const DisplayProfile& display, const PoppingSettings& settings,
                    const TemporalChannels& channels, const ResponseTableGrid& grid);
  /// Before the response of a level is computed.
  void bind(const gl::Program& program, double peakCpd) const;
  int64_t bytes() const { return steady_.bytes() + onset_.bytes(); }

 private:
  gl::Texture steady_, onset_;
  double framesHeldS_;  // that a frame is lit
};

}  // namespace limen::perception
