// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/pixel_counts.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen::techniques {

void PixelCounts::add(const CountImages& images) {
  std::vector<uint32_t> newWork = images.work.readUint(), newSearch = images.search.readUint();
  if (work.empty()) {
    work = std::move(newWork);
    search = std::move(newSearch);
    return;
  }
  // A pixel's class is that of the map with the most work for it; later maps need not see everything.
  const auto rank = [](uint32_t kind) {
    constexpr std::array<int, ClassCount> kRank = {0, 1, 3, 4, 2, 5};
    return kRank.at(kind);
  };
  for (size_t i = 0; i < newWork.size(); i += 4) {
    const uint32_t kind = newWork[i] == Outside ? uint32_t{Lit} : newWork[i];
    if (rank(kind) > rank(work[i])) work[i] = kind;
    for (size_t channel = 1; channel < 3; ++channel) work[i + channel] += newWork[i + channel];
    work[i + 3] = std::max(work[i + 3], newWork[i + 3]);
    for (size_t channel = 0; channel < 3; ++channel) search[i + channel] += newSearch[i + channel];
  }
}

std::vector<Counter> visibilityCounters(const PixelCounts& counted) {
  std::array<double, ClassCount> pixels{};
  double occluders = 0.0, occludersSquared = 0.0, fetches = 0.0, allFetches = 0.0, levels = 0.0;
  double areaTexels = 0.0, examined = 0.0, used = 0.0;
  for (size_t i = 0; i < counted.work.size(); i += 4) {
    pixels.at(counted.work[i]) += 1.0;
    allFetches += counted.work[i + 2];
    if (counted.work[i] != Processed) continue;
    occluders += counted.work[i + 1];
    occludersSquared += double(counted.work[i + 1]) * counted.work[i + 1];
    fetches += counted.work[i + 2];
    levels += std::bit_cast<float>(counted.search[i + 3]);
    areaTexels += counted.search[i];
    examined += counted.search[i + 1];
    used += counted.search[i + 2];
  }
  const double all = static_cast<double>(counted.work.size()) / 4.0;
  if (pixels[CutShort] > 0.0)
    throw Error(shortestNumber(pixels[CutShort]) +
                    " pixels need more loop iterations than this software renderer allows",
                {}, "set 'budget', lower 'resolution', or run on a GPU");
  const double processed = pixels[Processed], receivers = all - pixels[NotReceiver];
  const auto share = [&](double part) { return all > 0.0 ? part / all : 0.0; };
  const auto perProcessed = [&](double sum) { return processed > 0.0 ? sum / processed : 0.0; };
  const double mean = perProcessed(occluders);
  const double variance = perProcessed(occludersSquared) - mean * mean;
  return {{"fetches_per_receiver", receivers > 0.0 ? allFetches / receivers : 0.0},
          {"fetches_per_px", perProcessed(fetches)},
          {"micro_occluders_per_px", mean},
          {"micro_occluders_sd", std::sqrt(std::max(variance, 0.0))},
          {"search_area_texels", perProcessed(areaTexels)},
          {"wasted_share", examined > 0.0 ? 1.0 - used / examined : 0.0},
          {"level_mean", perProcessed(levels)},
          {"receivers_share", share(receivers)},
          {"lit_share", share(pixels[Lit])},
          {"umbra_share", share(pixels[Umbra])},
          {"processed_share", share(processed)},
          {"outside_map_share", share(pixels[Outside])}};
}

std::vector<Quantity> visibilityQuantities() {
  constexpr Direction kLower = Direction::LowerIsBetter, kNeither = Direction::Neither;
  return {{"fetches_per_receiver", "Texels read per receiver", "1/px", kLower},
          {"fetches_per_px", "Texels read per processed pixel", "1/px", kLower},
          {"micro_occluders_per_px", "Micro-occluders per pixel", "1/px", kLower},
          {"micro_occluders_sd", "Standard deviation of micro-occluders", "1/px", kNeither},
          {"search_area_texels", "Search area", "texel", kLower},
          {"wasted_share", "Share of micro-occluders that cover nothing", "", kNeither},
          {"level_mean", "Mean level", "", kNeither},
          {"receivers_share", "Share of receivers", "", kNeither},
          {"lit_share", "Share of lit pixels", "", kNeither},
          {"umbra_share", "Share of pixels in umbra", "", kNeither},
          {"processed_share", "Share of processed pixels", "", kNeither},
          {"outside_map_share", "Share of pixels outside the map", "", kNeither}};
}

}  // namespace limen::techniques
