// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/global_illumination/voxel_propagation/surface_samples.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace limen::techniques {
namespace {

/// A triangle in rows parallel to its longest side, which is from corner `from` to `to`.
struct Rows {
  size_t apex = 0, from = 1, to = 2;
  double longest = 0.0, area = 0.0;
  int64_t count = 0;  ///< 0: it is left out

  Rows(const std::array<glm::dvec3, 3>& corners, double spacing) {
    for (size_t c = 0; c < 3; ++c) {
      const double side = glm::length(corners[(c + 2) % 3] - corners[(c + 1) % 3]);
      if (side > longest) longest = side, apex = c, from = (c + 1) % 3, to = (c + 2) % 3;
    }
    area = 0.5 * glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    if (area > 0.0 && std::isfinite(longest)) count = parts(2.0 * area / longest, spacing);
  }
  /// Of row 0 .. count - 1, the widest first: share of the longest side at half its height, and of the area.
  double widthOf(int64_t row) const { return 1.0 - (double(row) + 0.5) / double(count); }
  double areaOf(int64_t row) const {
    return (2.0 * double(count - row) - 1.0) / (double(count) * double(count));
  }
  int64_t samplesOf(int64_t row, double spacing) const { return parts(longest * widthOf(row), spacing); }

  static int64_t parts(double length, double spacing) {
    return std::max<int64_t>(1, static_cast<int64_t>(std::ceil(length / spacing)));
  }
};

}  // namespace

std::vector<SurfaceSample> sampleSurfaces(const scene::Scene& scene, double spacing, size_t mostSamples) {
  const scene::Mesh& mesh = scene.mesh;
  const auto cornersOf = [&](size_t t) {
    std::array<glm::dvec3, 3> corners{};
    for (int c = 0; c < 3; ++c) corners[size_t(c)] = mesh.positions[mesh.triangles[t][c]];
    return corners;
  };
  for (;; spacing *= 1.5) {
    const double most = double(std::max(mostSamples, mesh.triangles.size()));
    double total = 0.0;
    for (size_t t = 0; t < mesh.triangles.size() && total <= most; ++t) {
      const Rows rows(cornersOf(t), spacing);
      for (int64_t row = 0; row < rows.count && total <= most; ++row)
        total += double(rows.samplesOf(row, spacing));
    }
    if (total <= most) break;
  }
  std::vector<SurfaceSample> out;
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Rows rows(cornersOf(t), spacing);
    for (int64_t row = 0; row < rows.count; ++row) {
      const int64_t count = rows.samplesOf(row, spacing);
      const double width = rows.widthOf(row), area = rows.area * rows.areaOf(row) / double(count);
      for (int64_t i = 0; i < count; ++i) {
        std::array<double, 3> weights{};
        weights[rows.apex] = 1.0 - width;
        weights[rows.to] = width * (double(i) + 0.5) / double(count);
        weights[rows.from] = width - weights[rows.to];
        out.push_back(
            {static_cast<uint32_t>(t), static_cast<float>(weights[1]), static_cast<float>(weights[2]), area});
      }
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
