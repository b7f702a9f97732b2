// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/perceptual_lod/layers.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "experiments/base/error.h"

namespace limen::techniques {
namespace {

constexpr const char* kLayerSource = "Schwarz 2009, section 9.5 (not given there)";
constexpr int kMostLayers = 8;

std::vector<double> readBorders(const std::string& text) {
  std::vector<double> out;
  size_t at = 0;
  while (at < text.size()) {
    if (text[at] == ' ' || text[at] == ',') {
      ++at;
      continue;
    }
    double value = 0.0;
    const auto [end, problem] = std::from_chars(text.data() + at, text.data() + text.size(), value);
    if (problem != std::errc() || !(value > 0.0) || !std::isfinite(value) ||
        (!out.empty() && value <= out.back()))
      throw Error("'" + text + "' is not a list of ascending distances", "borders",
                  "write them like \"2.5, 5, 10\"");
    out.push_back(value);
    at = static_cast<size_t>(end - text.data());
  }
  if (out.empty() || out.size() >= kMostLayers)
    throw Error("explicit layers with " + std::to_string(out.size()) + " borders", "borders",
                "give 1 to " + std::to_string(kMostLayers - 1));
  return out;
}

}  // namespace

const SettingsTable<LayerRange>& LayerRange::table() {
  using S = LayerRange;
  static const SettingsTable<S> kTable = {
      {&S::count, "count", {1, kMostLayers}, "", "Layers of objects besides the background", kLayerSource},
      Binding(&S::nearest, "nearest", Range{0.0, 1e9}, "world units",
              "Start of the first layer; 0: at the nearest object of each frame", kLayerSource)
          .formerly({"nearest"}),
      Binding(&S::farthest, "farthest", Range{0.0, 1e9}, "world units",
              "End of the last layer; 0: at the farthest object of each frame", kLayerSource)
          .formerly({"farthest"})};
  return kTable;
}

void LayerRange::check() const {
  if (farthest > 0.0 && farthest <= nearest)
    throw Error("the layers end before they begin", "farthest", "give a distance above nearest, or 0");
}

const SettingsTable<LogLayers>& LogLayers::table() {
  static const SettingsTable<LogLayers> kTable = {included(&LogLayers::range)};
  return kTable;
}

const SettingsTable<UniformLayers>& UniformLayers::table() {
  static const SettingsTable<UniformLayers> kTable = {included(&UniformLayers::range)};
  return kTable;
}

const SettingsTable<ExplicitLayers>& ExplicitLayers::table() {
  static const SettingsTable<ExplicitLayers> kTable = {
      Binding(&ExplicitLayers::borders, "borders",
              "Distances at which the next layer begins, ascending, in world units")
          .formerly({"borders"})};
  return kTable;
}

std::vector<double> ExplicitLayers::distances() const { return readBorders(borders); }

int layerCount(const LayerPartition& partition) {
  if (const auto* given = std::get_if<ExplicitLayers>(&partition))
    return static_cast<int>(given->distances().size()) + 1;
  const auto* log = std::get_if<LogLayers>(&partition);
  return log ? log->range.count : std::get<UniformLayers>(partition).range.count;
}

std::vector<double> layerBorders(const LayerPartition& partition, const std::vector<double>& distances) {
  if (const auto* given = std::get_if<ExplicitLayers>(&partition)) return given->distances();
  const auto* log = std::get_if<LogLayers>(&partition);
  const LayerRange& range = log ? log->range : std::get<UniformLayers>(partition).range;
  double low = range.nearest, high = range.farthest;
  if (!distances.empty()) {
    const auto [least, most] = std::minmax_element(distances.begin(), distances.end());
    if (low <= 0.0) low = *least;
    if (high <= 0.0) high = *most;
  }
  std::vector<double> out;
  for (int i = 1; i < range.count; ++i) {
    const double share = static_cast<double>(i) / range.count;
    double border = std::numeric_limits<double>::infinity();
    if (high > low)
      border = log && low > 0.0 ? low * std::pow(high / low, share) : low + (high - low) * share;
    out.push_back(border);
  }
  return out;
}

std::vector<int> assignLayers(const LayerPartition& partition, const std::vector<double>& distances) {
  const std::vector<double> borders = layerBorders(partition, distances);
  std::vector<int> out;
  for (const double distance : distances)
    out.push_back(
        static_cast<int>(std::upper_bound(borders.begin(), borders.end(), distance) - borders.begin()));
  return out;
}

}  // namespace limen::techniques
