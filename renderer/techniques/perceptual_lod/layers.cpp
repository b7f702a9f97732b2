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
      throw Error("'" + text + "' is no list of ascending distances", "borders",
                  "write them like \"2.5, 5, 10\"");
    out.push_back(value);
    at = static_cast<size_t>(end - text.data());
  }
  if (out.empty() || out.size() >= kMostLayers)
    throw Error("partition: explicit with " + std::to_string(out.size()) + " borders", "borders",
                "give 1 to " + std::to_string(kMostLayers - 1));
  return out;
}

}  // namespace

std::vector<Parameter> LayerSettings::parameters() {
  Parameter borders;
  borders.name = "borders";
  borders.type = ParameterType::Text;
  borders.defaultValue = std::string("5, 10");
  borders.unit = "world units";
  borders.description = "partition explicit: distances at which the next layer begins, ascending";
  return {
      integerParameter("layers", 4, 1, kMostLayers, "",
                       "Layers of objects beside the background; partition explicit has its own number",
                       kLayerSource),
      choiceParameter("partition", "log", {"uniform", "log", "explicit"},
                      "Where layers meet: at even distances, even ratios, or given distances", kLayerSource),
      realParameter("nearest", 0.0, 0.0, 1e9, "world units",
                    "Where the first layer begins; 0: at the nearest object of each frame", kLayerSource),
      realParameter("farthest", 0.0, 0.0, 1e9, "world units",
                    "Where the last layer ends; 0: at the farthest object of each frame", kLayerSource),
      borders};
}

LayerSettings LayerSettings::from(const ParameterValues& values) {
  LayerSettings out;
  out.count = static_cast<int>(values.integer("layers"));
  const std::string& partition = values.text("partition");
  out.partition = partition == "uniform"    ? Partition::Uniform
                  : partition == "explicit" ? Partition::Explicit
                                            : Partition::Log;
  out.nearest = values.real("nearest");
  out.farthest = values.real("farthest");
  if (out.partition == Partition::Explicit) {
    out.borders = readBorders(values.text("borders"));
    out.count = static_cast<int>(out.borders.size()) + 1;
  }
  if (out.farthest > 0.0 && out.farthest <= out.nearest)
    throw Error("the layers end before they begin", "farthest", "give a distance above nearest, or 0");
  return out;
}

std::vector<double> layerBorders(const LayerSettings& settings, const std::vector<double>& distances) {
  if (settings.partition == LayerSettings::Partition::Explicit) return settings.borders;
  double low = settings.nearest, high = settings.farthest;
  if (!distances.empty()) {
    const auto [least, most] = std::minmax_element(distances.begin(), distances.end());
    if (low <= 0.0) low = *least;
    if (high <= 0.0) high = *most;
  }
  std::vector<double> out;
  for (int i = 1; i < settings.count; ++i) {
    const double share = static_cast<double>(i) / settings.count;
    double border = std::numeric_limits<double>::infinity();
    if (high > low)
      border = settings.partition == LayerSettings::Partition::Log && low > 0.0
                   ? low * std::pow(high / low, share)
                   : low + (high - low) * share;
    out.push_back(border);
  }
  return out;
}

std::vector<int> assignLayers(const LayerSettings& settings, const std::vector<double>& distances) {
  const std::vector<double> borders = layerBorders(settings, distances);
  std::vector<int> out;
  for (const double distance : distances)
    out.push_back(
        static_cast<int>(std::upper_bound(borders.begin(), borders.end(), distance) - borders.begin()));
  return out;
}

}  // namespace limen::techniques
