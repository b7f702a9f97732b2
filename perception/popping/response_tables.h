// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>

#include <memory>

#include "perception/popping/predictor.h"

namespace limen::perception {

/// Nodes of the GPU predictor's tables over retinal velocity, across, and luminance, down.
struct ResponseTableGrid {
  glm::dvec2 low, per;  ///< log2 of the first node; nodes per octave
  glm::ivec2 size;
  /// Whether castleCSF's kink (castleKinkCdM2()) is among the luminances. Then a node lies on it, at
  /// `kinkRow`, and the next kPoppingKinkNodes, up to kPoppingKinkEndCdM2, are rows of OnsetTable: equal
  /// steps of the kCastleKinkExponent-th power of the logarithm of luminance over the kink's. `perAbove`
  /// nodes an octave follow.
  bool hasKink = false;
  int kinkRow = 0;
  double perAbove = 0.0;

  ResponseTableGrid(const PoppingSettings& settings, const DisplayProfile& display);
  double velocityDegS(int column) const;
  double luminanceCdM2(int row) const;  ///< of a row of a table of blocks, too
};

/// Tables for gpu/response.glsl, in blocks of the grid one below the other, for each level: sensitivities at
/// its peak. They take a tenth of a second or more, seconds with fitted weights, and are the same for all
/// runs of a sweep on one display: the last few are cached.
std::shared_ptr<const Image> sensitivityTable(const PoppingModel& model, const DisplayProfile& display,
                                              const PoppingSettings& settings, const ResponseTableGrid& grid);

/// Relative weights of the levels' parts (BandWeights) at their own nodes: a block for each level and part.
struct PartWeightTable {
  Image weights;
  glm::dvec2 low, per;  ///< as of ResponseTableGrid
  glm::ivec2 size;
};
std::shared_ptr<const PartWeightTable> partWeightTable(const PoppingModel& model,
                                                       const DisplayProfile& display,
                                                       const PoppingSettings& settings);

/// Gains of TemporalSensitivity, a block for each level.
struct TemporalTables {
  Image steady, onset;
};
std::shared_ptr<const TemporalTables> temporalTables(const PoppingModel& model, const DisplayProfile& display,
                                                     const PoppingSettings& settings,
                                                     const TemporalChannels& channels,
                                                     const ResponseTableGrid& grid);

/// Size of sensitivityTable() and of both of temporalTables().
glm::ivec2 responseTablePx(const PoppingModel& model, const ResponseTableGrid& grid);

}  // namespace limen::perception
