// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>

#include "perception/popping/temporal_sensitivity.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"

namespace limen::perception {

/// Nodes of a table over retinal velocity and luminance.
struct TemporalGrid {
  glm::dvec2 low, per;  ///< log2 of the first node; nodes per octave
  glm::ivec2 size;
  glm::ivec2 tablePx(const PoppingModel& model) const;  ///< of all levels, one below the other
};

/// Gains of TemporalSensitivity for the GPU's predictor (gpu/temporal.glsl).
class TemporalTablesGpu {
 public:
  /// Levels lie one below the other, as in the predictor's table of sensitivities.
  TemporalTablesGpu(const PoppingModel& model, const DisplayProfile& display, const PoppingSettings& settings,
                    const TemporalChannels& channels, const TemporalGrid& grid);
  /// Before the response of a level is computed.
  void bind(const gl::Program& program, double peakCpd) const;
  int64_t bytes() const { return steady_.bytes() + onset_.bytes(); }

 private:
  gl::Texture steady_, onset_;
  double framesHeldS_;  // that a frame is lit
};

}  // namespace limen::perception
