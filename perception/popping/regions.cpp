// SPDX-License-Identifier: BSD-3-Clause
#include "perception/popping/regions.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "perception/image_analysis/connected_components.h"

namespace limen::perception {
double poppingRating(double sigma, const PoppingSettings& settings) {
  if (!(sigma > 0.0)) return -std::numeric_limits<double>::infinity();
  return std::log(settings.rating.scale * sigma) / std::log(settings.rating.base);
}

RegionMap findRegions(const std::vector<double>& jnd, const std::vector<uint8_t>& seeds, int width,
                      int height, const PoppingSettings& settings) {
  const size_t pixels = static_cast<size_t>(width) * height;
  assert(jnd.size() == pixels && (seeds.empty() || seeds.size() == pixels));
  std::vector<uint8_t> above(pixels);
  for (size_t pixel = 0; pixel < pixels; ++pixel)
    above[pixel] = std::isfinite(jnd[pixel]) && jnd[pixel] >= settings.regions.thresholdJnd;
  RegionMap map;
  map.width = width, map.height = height;
  map.labels = connectedComponents(above, width, height, settings.regions.connectivity);

  std::vector<uint8_t> seeded;  // by component
  for (size_t pixel = 0; pixel < pixels; ++pixel) {
    const uint32_t component = map.labels[pixel];
    if (component >= seeded.size()) seeded.resize(component + size_t{1}, 0);
    if (component > 0 && (seeds.empty() || seeds[pixel])) seeded[component] = 1;
  }
  std::vector<uint32_t> labels(seeded.size(), 0);  // by component: its number among those with a seed
  size_t pixel = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x, ++pixel) {
      const uint32_t component = map.labels[pixel];
      if (!seeded[component]) {
        map.labels[pixel] = 0;
        continue;
      }
      if (labels[component] == 0) {  // its first pixel
        PoppingRegion region;
        region.label = labels[component] = static_cast<uint32_t>(map.regions.size() + 1);
        region.least = region.most = {x, y};
        map.regions.push_back(region);
      }
      map.labels[pixel] = labels[component];
      PoppingRegion& region = map.regions[map.labels[pixel] - 1];
      region.least = glm::min(region.least, glm::ivec2(x, y));
      region.most = glm::max(region.most, glm::ivec2(x, y));
      region.largestJnd = std::max(region.largestJnd, jnd[pixel]);
      region.centroidPx += glm::dvec2(x + 0.5, y + 0.5);
      region.sigma += std::pow(jnd[pixel], settings.minkowskiExponent);
      ++region.sizePx;
    }
  for (PoppingRegion& region : map.regions) {
    region.sigma = std::pow(region.sigma, 1.0 / settings.minkowskiExponent);
    region.rating = poppingRating(region.sigma, settings);
    region.centroidPx /= static_cast<double>(region.sizePx);
    region.coverage = static_cast<double>(region.sizePx) / static_cast<double>(pixels);
    region.detectionProbability = settings.detection.probability(region.rating);
  }
  return map;
}

const PoppingRegion* RegionMap::at(int x, int y) const {
  if (x < 0 || y < 0 || x >= width || y >= height) return nullptr;
  const uint32_t label = labels[static_cast<size_t>(y) * width + x];
  return label == 0 ? nullptr : &regions[label - 1];
}

std::vector<RegionMap::Share> RegionMap::in(glm::ivec2 least, glm::ivec2 most) const {
  std::map<uint32_t, int64_t> counts;
  for (int y = std::max(least.y, 0); y <= std::min(most.y, height - 1); ++y)
    for (int x = std::max(least.x, 0); x <= std::min(most.x, width - 1); ++x)
      if (const uint32_t label = labels[static_cast<size_t>(y) * width + x]) ++counts[label];
  std::vector<Share> shares;
  for (const auto& [label, pixels] : counts) shares.push_back({&regions[label - 1], pixels});
  std::stable_sort(shares.begin(), shares.end(),
                   [](const Share& a, const Share& b) { return a.pixels > b.pixels; });
  return shares;
}

double RegionMap::coverageOf(const Image& mask) const {
  assert(mask.width == width && mask.height == height);
  int64_t object = 0, popping = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (!(mask.at(x, y) > 0.0F)) continue;
      ++object;
      if (labels[static_cast<size_t>(y) * width + x]) ++popping;
    }
  return object == 0 ? 0.0 : static_cast<double>(popping) / static_cast<double>(object);
}

}  // namespace limen::perception
