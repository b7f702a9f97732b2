// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/search_pictures.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

namespace limen::techniques {
namespace {

constexpr double kLeastTexels = 10.0, kMiddleTexels = 400.0, kMostTexels = 6000.0;
constexpr double kCoarsestLevel = 5.0;
constexpr double kLeastRoot = 4.0, kMostRoot = 36.0;  // 12 is halfway between their logarithms

/// Blue at 0, green at 1/2, red at 1.
glm::vec3 heat(double value) {
  const auto t = static_cast<float>(2.0 * std::clamp(value, 0.0, 1.0));
  return t < 1.0F ? glm::mix(glm::vec3(0, 0, 1), glm::vec3(0, 1, 0), t)
                  : glm::mix(glm::vec3(0, 1, 0), glm::vec3(1, 0, 0), t - 1.0F);
}

double areaHeat(double texels) {
  return texels < kMiddleTexels
             ? 0.5 * std::log(std::max(texels, kLeastTexels) / kLeastTexels) /
                   std::log(kMiddleTexels / kLeastTexels)
             : 0.5 + 0.5 * std::log(texels / kMiddleTexels) / std::log(kMostTexels / kMiddleTexels);
}

template <class HeatOf>
Image picture(const PixelCounts& counted, HeatOf heatOf) {
  std::array<glm::vec3, ClassCount> colours{};
  colours[Lit] = glm::vec3(0.8F);
  colours[Umbra] = glm::vec3(0.25F);
  colours[Outside] = glm::vec3(0.8F, 0.8F, 0.6F);
  colours[CutShort] = glm::vec3(1, 0, 1);
  Image out(counted.sizePx.x, counted.sizePx.y, 3);
  for (size_t i = 0; i < out.pixels(); ++i) {
    const uint32_t kind = counted.work[4 * i];
    const glm::vec3 colour = kind == Processed ? heat(heatOf(i)) : colours.at(kind);
    for (int c = 0; c < 3; ++c) out.data[3 * i + static_cast<size_t>(c)] = colour[c];
  }
  return out;
}

}  // namespace

Image searchAreaPicture(const PixelCounts& counted) {
  // Areas are whole numbers, and all from kMostTexels on look the same.
  static const std::vector<double> kHeats = [] {
    std::vector<double> out;
    for (double texels = 0.0; texels <= kMostTexels; texels += 1.0) out.push_back(areaHeat(texels));
    return out;
  }();
  return picture(
      counted, [&](size_t i) { return kHeats[std::min<size_t>(counted.search[4 * i], kHeats.size() - 1)]; });
}

Image levelPicture(const PixelCounts& counted) {
  return picture(counted,
                 [&](size_t i) { return std::bit_cast<float>(counted.search[4 * i + 3]) / kCoarsestLevel; });
}

Image budgetPicture(const Image& budgets) {
  Image out(budgets.width, budgets.height, 3);
  for (size_t i = 0; i < out.pixels(); ++i) {
    const double root = std::sqrt(double{budgets.data[i]});
    const glm::vec3 colour =
        heat(root > 0.0 ? std::log(root / kLeastRoot) / std::log(kMostRoot / kLeastRoot) : 1.0);
    for (int c = 0; c < 3; ++c) out.data[3 * i + static_cast<size_t>(c)] = colour[c];
  }
  return out;
}

}  // namespace limen::techniques
