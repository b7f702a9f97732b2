// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "perception/threshold_maps/model.h"

namespace limen::perception {

/// Tables of a model over lg luminance, from 1e-4 to 1e6 cd/m2 in cells of 1/250 decade, for linear
/// interpolation inside each cell: a cell holds the values at both of its own ends, so that the steps of the
/// TVI, whose knots lie on ends of cells, stay steps. A cell is 1 + bands vectors: (TVI, TVI, peak
/// sensitivity, peak sensitivity), then for each band (csf, csf, F, F).
std::vector<glm::vec4> thresholdTables(const ThresholdModel& model);

/// Elevation of masking over CSF-normalised contrast, for linear interpolation: 32 segments of equal width
/// per octave from 2^-20 to 2^44, each (value at its start, rise over it). Of a function as steep as c^p the
/// interpolation is off by |p (p - 1)| / 8192 at most.
std::vector<glm::vec2> elevationTable(const ThresholdModel& model);

/// Positions of samples on a neighbouring level, as (left, t): for each level i from 0 to levels - 2 its
/// columns and rows on level i + 1 (`upward`: first entries), then those of level i + 1 on level i
/// (`downward`).
struct LevelPlaces {
  std::vector<glm::vec2> places;
  std::vector<glm::ivec2> upward, downward;
};
LevelPlaces levelPlaces(glm::ivec2 sizePx, int levels);

/// How levels 1 to levels - 1 are upsampled to full size along one axis of `size` pixels: for each level and
/// pixel (first sample, its weight, weight of the third, 0); the second has the rest. Bilinear: `direct` from
/// the level itself, otherwise via every level in between.
std::vector<glm::vec4> levelTaps(int size, int levels, bool direct);

/// Samples of levels 1 to levels - 1 that tiles of `tilePx` pixels of an axis touch through levelTaps():
/// (first, count) for each tile and level; samples beyond the ends are the end samples.
std::vector<glm::ivec2> tilePatches(const std::vector<glm::vec4>& taps, int size, int tilePx, int levels);

}  // namespace limen::perception
