// SPDX-License-Identifier: BSD-3-Clause
#include "perception/popping/regions.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace limen::perception {
namespace {

constexpr uint32_t kOutside = std::numeric_limits<uint32_t>::max();

/// Sets of pixels; the root of a set is its first pixel, row by row.
class PixelSets {
 public:
  explicit PixelSets(size_t pixels) : parent_(pixels, kOutside) {}
  void make(uint32_t pixel) { parent_[pixel] = pixel; }
  bool holds(uint32_t pixel) const { return parent_[pixel] != kOutside; }
  uint32_t root(uint32_t pixel) {
    while (parent_[pixel] != pixel) {
      parent_[pixel] = parent_[parent_[pixel]];
      pixel = parent_[pixel];
    }
    return pixel;
  }
  void unite(uint32_t a, uint32_t b) {
    a = root(a), b = root(b);
    if (a < b) parent_[b] = a;
    if (b < a) parent_[a] = b;
  }

 private:
  std::vector<uint32_t> parent_;
};

}  // namespace

double poppingRating(double sigma, const PoppingSettings& settings) {
  if (!(sigma > 0.0)) return -std::numeric_limits<double>::infinity();
  return std::log(settings.rating.scale * sigma) / std::log(settings.rating.base);
}

RegionMap findRegions(const std::vector<double>& jnd, const std::vector<uint8_t>& seeds, int width,
                      int height, const PoppingSettings& settings) {
  const size_t pixels = static_cast<size_t>(width) * height;
  assert(jnd.size() == pixels && (seeds.empty() || seeds.size() == pixels) && pixels < kOutside);
  const bool diagonal = settings.regions.connectivity == 8;
  const auto pixelAt = [&](int x, int y) {
    return static_cast<uint32_t>(static_cast<size_t>(y) * width + x);
  };

  PixelSets sets(pixels);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const uint32_t pixel = pixelAt(x, y);
      if (!(jnd[pixel] >= settings.regions.thresholdJnd) || !std::isfinite(jnd[pixel])) continue;
      sets.make(pixel);
      if (x > 0 && sets.holds(pixel - 1)) sets.unite(pixel, pixel - 1);
      if (y == 0) continue;
      for (int dx = diagonal ? -1 : 0; dx <= (diagonal ? 1 : 0); ++dx)
        if (x + dx >= 0 && x + dx < width && sets.holds(pixelAt(x + dx, y - 1)))
          sets.unite(pixel, pixelAt(x + dx, y - 1));
    }

  std::vector<uint8_t> seeded(pixels, 0);
  for (uint32_t pixel = 0; pixel < pixels; ++pixel)
    if (sets.holds(pixel) && (seeds.empty() || seeds[pixel])) seeded[sets.root(pixel)] = 1;

  RegionMap map;
  map.width = width, map.height = height;
  map.labels.assign(pixels, 0);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const uint32_t pixel = pixelAt(x, y);
      if (!sets.holds(pixel)) continue;
      const uint32_t root = sets.root(pixel);
      if (!seeded[root]) continue;
      if (pixel == root) {  // met before all other pixels of the set
        PoppingRegion region;
        region.label = static_cast<uint32_t>(map.regions.size() + 1);
        region.least = region.most = {x, y};
        map.regions.push_back(region);
        map.labels[pixel] = region.label;
      }
      map.labels[pixel] = map.labels[root];
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
