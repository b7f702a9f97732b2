// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/global_illumination/voxel_propagation/surface_samples.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace limen::techniques {
namespace {

/// Parts of each side; 0: left out.
int64_t partsOfSide(const std::array<glm::dvec3, 3>& corners, double spacing) {
  const double longest = std::max({glm::length(corners[1] - corners[0]), glm::length(corners[2] - corners[1]),
                                   glm::length(corners[0] - corners[2])});
  const double area = 0.5 * glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
  if (!(area > 0.0) || !std::isfinite(longest)) return 0;
  return std::max<int64_t>(1, static_cast<int64_t>(std::ceil(longest / spacing)));
}

}  // namespace

std::vector<SurfaceSample> sampleSurfaces(const scene::Scene& scene, double spacing, size_t mostSamples) {
  const scene::Mesh& mesh = scene.mesh;
  const auto cornersOf = [&](size_t t) {
    std::array<glm::dvec3, 3> corners{};
    for (int c = 0; c < 3; ++c) corners[size_t(c)] = mesh.positions[mesh.triangles[t][c]];
    return corners;
  };
  for (;; spacing *= 1.5) {
    double total = 0.0;
    for (size_t t = 0; t < mesh.triangles.size(); ++t)
      total += std::pow(double(partsOfSide(cornersOf(t), spacing)), 2.0);
    if (total <= double(std::max(mostSamples, mesh.triangles.size()))) break;
  }
  std::vector<SurfaceSample> out;
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::array<glm::dvec3, 3> corners = cornersOf(t);
    const int64_t n = partsOfSide(corners, spacing);
    if (n == 0) continue;
    const double area = 0.5 * glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    const double part = 1.0 / double(n);
    for (int64_t j = 0; j < n; ++j)
      for (int64_t i = 0; i < n - j; ++i)
        for (int upper = 0; upper < (i < n - j - 1 ? 2 : 1); ++upper) {
          const double third = upper == 0 ? 1.0 / 3.0 : 2.0 / 3.0;
          out.push_back({static_cast<uint32_t>(t), static_cast<float>((double(i) + third) * part),
                         static_cast<float>((double(j) + third) * part), area * part * part});
        }
  }
  return out;
}

SampleTexture sampleTexture(const scene::Scene& scene, double spacing, double unitArea) {
  constexpr int kRow = 2048;
  constexpr size_t kMostSamples = 4U << 20U;  // 64 MiB
  const std::vector<SurfaceSample> samples = sampleSurfaces(scene, spacing, kMostSamples);
  SampleTexture out;
  out.count = static_cast<uint32_t>(samples.size());
  out.sizePx = {kRow, std::max(1, static_cast<int>((samples.size() + kRow - 1) / kRow))};
  out.texels.assign(size_t{4} * kRow * size_t(out.sizePx.y), 0U);
  for (size_t i = 0; i < samples.size(); ++i) {
    out.texels[4 * i] = samples[i].triangle;
    out.texels[4 * i + 1] = std::bit_cast<uint32_t>(samples[i].u);
    out.texels[4 * i + 2] = std::bit_cast<uint32_t>(samples[i].v);
    out.texels[4 * i + 3] = std::bit_cast<uint32_t>(static_cast<float>(samples[i].area / unitArea));
  }
  return out;
}

}  // namespace limen::techniques
