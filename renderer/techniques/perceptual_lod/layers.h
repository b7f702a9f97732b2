// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "experiments/base/settings_table.h"

namespace limen::techniques {

// How objects with levels of detail are distributed among layers: by distance from the eye to the centre of
// their bounds. Source: Schwarz 2009, section 9.5, which specifies neither the number of layers nor the
// borders.

/// A range of distances to be divided.
struct LayerRange {
  int count = 4;  ///< layers of objects; the background is one more
  /// Ends of the range, world units; 0: distance of the nearest or farthest object.
  double nearest = 0.0, farthest = 0.0;
  static const SettingsTable<LayerRange>& table();
  void check() const;
};

struct LogLayers {
  static constexpr const char *kKind = "log", *kSummary = "logarithmically spaced borders";
  LayerRange range;
  static const SettingsTable<LogLayers>& table();
};

struct UniformLayers {
  static constexpr const char *kKind = "uniform", *kSummary = "evenly spaced borders";
  LayerRange range;
  static const SettingsTable<UniformLayers>& table();
};

struct ExplicitLayers {
  static constexpr const char *kKind = "explicit", *kSummary = "given borders";
  std::string borders = "5, 10";  ///< ascending distances at which the next layer begins
  static const SettingsTable<ExplicitLayers>& table();
  void check() const { distances(); }
  /// Throws Error on borders that are not ascending positive numbers.
  std::vector<double> distances() const;
};

using LayerPartition = std::variant<LogLayers, UniformLayers, ExplicitLayers>;

/// Layers of objects; the background is one more.
int layerCount(const LayerPartition& partition);
/// Borders between layers, ascending, one fewer than layers. A distance on a border belongs to the farther
/// layer. Empty input, or a range without extent, gives borders that put everything into layer 0.
std::vector<double> layerBorders(const LayerPartition& partition, const std::vector<double>& distances);
/// Layer of each distance, 0 (nearest) to count - 1.
std::vector<int> assignLayers(const LayerPartition& partition, const std::vector<double>& distances);

}  // namespace limen::techniques
