// SPDX-License-Identifier: BSD-3-Clause
#include "perception/popping/response_tables.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <mutex>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "experiments/base/text.h"
#include "perception/popping/gpu/popping_bindings.h"
#include "perception/popping/sensitivity.h"
#include "perception/popping/temporal_sensitivity.h"
#include "perception/vision/castle_csf.h"

namespace limen::perception {
namespace {

// Nodes in a decade of velocity and luminance: sensitivities are straight enough between them for an error
// below 1e-3 of a response. Velocity needs the most: sensitivity to fast patterns falls steeply with it.
const glm::dvec2 kTableNodesPerDecade(130.0, 33.0);
constexpr double kTableFastest = 1e3, kTableSlowest = 1e-5;    ///< deg/s
constexpr double kTableBrightest = 1e4, kTableDarkest = 1e-4;  ///< cd/m2; adaptation is clamped to this range

/// Velocity of the table's first node: the smallest retinal velocity of the eye model.
double slowest(const PoppingSettings& settings) {
  const EyeMovement model = settings.eyeModel();
  const bool hasFloor = model == EyeMovement::Floor || model == EyeMovement::Monotone;
  return hasFloor ? std::clamp(settings.leastVelocityDegS(), kTableSlowest, 0.5 * kTableFastest)
                  : kTableSlowest;
}

/// Luminance of the first: no mean of pixels is darker than the display's black.
double darkest(const PoppingSettings& settings, const DisplayProfile& display) {
  const auto* fixed = std::get_if<FixedAdaptation>(&settings.adaptation);
  const double least = fixed ? fixed->luminanceCdM2 : display.blackLevelCdM2();
  return std::clamp(0.99 * least, kTableDarkest, 0.5 * kTableBrightest);
}

bool isCastle(const PoppingSettings& settings) {
  const SensitivitySettings& s = settings.sensitivity;
  return std::holds_alternative<TemporalChannels>(settings.temporal) ||
         s.achromatic.csf.name.starts_with("castlecsf") || s.redGreen.csf.name.starts_with("castlecsf") ||
         s.blueYellow.csf.name.starts_with("castlecsf");
}

/// Those at the bands' peaks, however weights are chosen.
Sensitivity peakSensitivity(const PoppingModel& model, const DisplayProfile& display,
                            PoppingSettings settings) {
  settings.bands.weights = PeakWeights{};
  return Sensitivity(model, display, settings, true);
}

Image makeSensitivityTable(const PoppingModel& model, const DisplayProfile& display,
                           const PoppingSettings& settings, const ResponseTableGrid& grid) {
  const glm::ivec2 px = responseTablePx(model, grid);
  Image table(px.x, px.y, 4);
  if (model.contrastLevels == 0) return table;
  const Sensitivity sensitivity = peakSensitivity(model, display, settings);
  forRowBlocks(table.height, static_cast<size_t>(table.width) * 1000, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < table.width; ++x) {
        const std::array<double, 3> at =
            sensitivity.at(y / grid.size.y, grid.velocityDegS(x), grid.luminanceCdM2(y));
        for (int c = 0; c < 3; ++c) table.at(x, y, c) = static_cast<float>(at[static_cast<size_t>(c)]);
      }
  });
  return table;
}

PartWeightTable makePartWeightTable(const PoppingModel& model, const DisplayProfile& display,
                                    const PoppingSettings& settings) {
  const Sensitivity sensitivity(model, display, settings, true);
  const auto& channels = sensitivity.partWeights();
  const BandWeights::Axis &velocity = channels[0]->velocityAxis(), &luminance = channels[0]->luminanceAxis();
  PartWeightTable out;
  out.size = {velocity.nodes, luminance.nodes};
  out.low = glm::dvec2(velocity.lnLow, luminance.lnLow) / std::numbers::ln2;
  out.per = glm::dvec2(velocity.perLn, luminance.perLn) * std::numbers::ln2;
  out.weights = Image(out.size.x, out.size.y * kBandParts * std::max(1, model.contrastLevels), 4);
  for (int level = 0; level < model.contrastLevels; ++level)
    for (int part = 0; part < kBandParts; ++part)
      for (int l = 0; l < out.size.y; ++l)
        for (int v = 0; v < out.size.x; ++v)
          for (int c = 0; c < 3; ++c)
            out.weights.at(v, (level * kBandParts + part) * out.size.y + l, c) = static_cast<float>(
                channels[static_cast<size_t>(c)]->atNode(level, v, l)[static_cast<size_t>(part)]);
  return out;
}

TemporalTables makeTemporalTables(const PoppingModel& model, const DisplayProfile& display,
                                  const PoppingSettings& settings, const TemporalChannels& channels,
                                  const ResponseTableGrid& grid) {
  const glm::ivec2 px = responseTablePx(model, grid);
  TemporalTables tables{Image(px.x, px.y, 4), Image(px.x, px.y, 4)};
  if (model.contrastLevels == 0) return tables;
  const Sensitivity sensitivity = peakSensitivity(model, display, settings);
  const TemporalSensitivity temporal(model, display, settings, channels, sensitivity);
  forRowBlocks(px.y, static_cast<size_t>(px.x) * 1000, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < px.x; ++x) {
        const TemporalGains gains =
            temporal.apart(y / grid.size.y, grid.velocityDegS(x), grid.luminanceCdM2(y));
        for (int m = 0; m < 4; ++m) {
          tables.steady.at(x, y, m) = static_cast<float>(gains[static_cast<size_t>(m)].steady);
          tables.onset.at(x, y, m) = static_cast<float>(gains[static_cast<size_t>(m)].onset);
        }
      }
  });
  return tables;
}

/// Everything that sensitivities are made of.
std::string keyOf(const PoppingModel& model, const DisplayProfile& display, const PoppingSettings& settings,
                  const ResponseTableGrid& grid) {
  const SensitivitySettings& s = settings.sensitivity;
  std::string key = display.hash() + "|" + s.achromatic.csf.name + "|" + s.redGreen.csf.name + "|" +
                    s.blueYellow.csf.name + "|" + std::to_string(model.contrastLevels) +
                    (settings.bands.isFitted() ? "|fitted" : "|peak") +
                    (settings.bands.upsampler() == Upsampler::Expand ? "|expand" : "|linear");
  const auto add = [&](double value) { key += "|" + shortestNumber(value); };
  for (const double value : model.peakCpd) add(value);
  for (const double value :
       {settings.bands.kernelCentre, settings.minkowskiExponent, model.areaDeg2, model.widthDeg, model.scaleA,
        model.scaleRg, model.scaleBy, Kelly83Scale::of(s.redGreen.csf).referenceCdM2,
        Kelly83Scale::of(s.blueYellow.csf).referenceCdM2, grid.low.x, grid.low.y, grid.per.x, grid.per.y,
        double(grid.size.x), double(grid.size.y), double(grid.kinkRow)})
    add(value);
  return key;
}

/// The last few tables by key.
template <class T>
class Cache {
 public:
  std::shared_ptr<const T> get(const std::string& key, const std::function<T()>& make) {
    constexpr size_t kKept = 8;
    const std::scoped_lock lock(guard_);
    for (const auto& [known, table] : kept_)
      if (known == key) return table;
    auto made = std::make_shared<const T>(make());
    if (kept_.size() == kKept) kept_.erase(kept_.begin());
    kept_.emplace_back(key, made);
    return made;
  }

 private:
  std::mutex guard_;
  std::vector<std::pair<std::string, std::shared_ptr<const T>>> kept_;
};

}  // namespace

ResponseTableGrid::ResponseTableGrid(const PoppingSettings& settings, const DisplayProfile& display)
    : low(std::log2(slowest(settings)), std::log2(darkest(settings, display))) {
  const glm::dvec2 perOctave = std::log10(2.0) * kTableNodesPerDecade;
  const glm::dvec2 octaves = glm::log2(glm::dvec2(kTableFastest, kTableBrightest)) - low;
  size = glm::ivec2(glm::ceil(octaves * perOctave)) + 1;
  per = glm::dvec2(size - 1) / octaves;
  const double kink = std::log2(castleKinkCdM2()), end = std::log2(double{kPoppingKinkEndCdM2});
  hasKink = isCastle(settings) && low.y < end;
  if (!hasKink) return;
  low.y = std::min(low.y, kink - 1.0 / perOctave.y);
  const double above = std::log2(kTableBrightest) - end;
  kinkRow = static_cast<int>(std::ceil((kink - low.y) * perOctave.y));
  const int rowsAbove = static_cast<int>(std::ceil(above * perOctave.y));
  per.y = kinkRow / (kink - low.y);
  perAbove = rowsAbove / above;
  size.y = kinkRow + kPoppingKinkNodes + rowsAbove + 1;
}

double ResponseTableGrid::velocityDegS(int column) const { return std::exp2(low.x + column / per.x); }

double ResponseTableGrid::luminanceCdM2(int row) const {
  const int node = row % size.y, fromKink = node - kinkRow;
  if (!hasKink || fromKink < 0) return std::exp2(low.y + node / per.y);
  if (fromKink >= kPoppingKinkNodes)
    return std::exp2(std::log2(double{kPoppingKinkEndCdM2}) + (fromKink - kPoppingKinkNodes) / perAbove);
  const double kink = castleKinkCdM2(), share = static_cast<double>(fromKink) / kPoppingKinkNodes;
  return kink * std::pow(kPoppingKinkEndCdM2 / kink, std::pow(share, 1.0 / kCastleKinkExponent));
}

std::shared_ptr<const Image> sensitivityTable(const PoppingModel& model, const DisplayProfile& display,
                                              const PoppingSettings& settings,
                                              const ResponseTableGrid& grid) {
  static Cache<Image> cache;
  return cache.get(keyOf(model, display, settings, grid),
                   [&] { return makeSensitivityTable(model, display, settings, grid); });
}

std::shared_ptr<const PartWeightTable> partWeightTable(const PoppingModel& model,
                                                       const DisplayProfile& display,
                                                       const PoppingSettings& settings) {
  static Cache<PartWeightTable> cache;
  return cache.get(keyOf(model, display, settings, ResponseTableGrid(settings, display)),
                   [&] { return makePartWeightTable(model, display, settings); });
}

std::shared_ptr<const TemporalTables> temporalTables(const PoppingModel& model, const DisplayProfile& display,
                                                     const PoppingSettings& settings,
                                                     const TemporalChannels& channels,
                                                     const ResponseTableGrid& grid) {
  static Cache<TemporalTables> cache;
  // The share of a frame that is shown enters as a uniform.
  return cache.get(keyOf(model, display, settings, grid) + "|" + shortestNumber(channels.windowS) + "|" +
                       shortestNumber(settings.leastVelocityDegS()),
                   [&] { return makeTemporalTables(model, display, settings, channels, grid); });
}

glm::ivec2 responseTablePx(const PoppingModel& model, const ResponseTableGrid& grid) {
  return {grid.size.x, grid.size.y * std::max(1, model.contrastLevels)};
}

}  // namespace limen::perception
