// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "experiments/base/parameter.h"

namespace limen::techniques {

/// How objects with levels of detail are shared among layers: by distance from the eye to the middle of their
/// bounds. Source: Schwarz 2009, section 9.5, which names neither the number of layers nor the borders.
struct LayerSettings {
  enum class Partition { Uniform, Log, Explicit };
  int count = 4;  ///< layers of objects; the background is one more
  Partition partition = Partition::Log;
  /// Ends of the range that is divided, world units; 0: distance of the nearest or farthest object.
  double nearest = 0.0, farthest = 0.0;
  std::vector<double> borders;  ///< Explicit: ascending; one fewer than layers

  /// layers, partition, nearest, farthest, borders.
  static std::vector<Parameter> parameters();
  /// Throws Error on borders that are no ascending positive numbers.
  static LayerSettings from(const ParameterValues& values);
};

/// Borders between layers, ascending, one fewer than layers. A distance on a border belongs to the farther
/// layer. Empty input, or a range without extent, gives borders that put all into layer 0.
std::vector<double> layerBorders(const LayerSettings& settings, const std::vector<double>& distances);
/// Layer of each distance, 0 (nearest) to count - 1.
std::vector<int> assignLayers(const LayerSettings& settings, const std::vector<double>& distances);

}  // namespace limen::techniques
