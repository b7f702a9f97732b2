// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/global_illumination/voxel_propagation/surface_samples.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace limen::techniques {
namespace {

/// A part of a triangle: its share of the area, and its middle: along the longest side and across it, in
/// shares of both.
struct Piece {
  double area = 0.0, along = 0.0, across = 0.0;
};

/// Of a convex polygon in these coordinates, in which a triangle's area is 1/2.
Piece pieceOf(const std::array<glm::dvec2, 8>& corners, size_t count) {
  Piece out;
  for (size_t i = 1; i + 1 < count; ++i) {
    const glm::dvec2 u = corners[i] - corners[0], v = corners[i + 1] - corners[0];
    const double area = 0.5 * (u.x * v.y - u.y * v.x);
    out.area += area;
    out.along += area * (corners[0].x + (u.x + v.x) / 3.0);
    out.across += area * (corners[0].y + (u.y + v.y) / 3.0);
  }
  out.along /= out.area, out.across /= out.area;
  return out;
}

/// A triangle in rows parallel to its longest side, which is from corner `from` to `to`.
struct Rows {
  size_t apex = 0, from = 1, to = 2;
  double longest = 0.0, area = 0.0;
  double apexAlong = 0.0;  ///< where the apex is along the longest side, share of it
  int64_t count = 0;       ///< 0: it is left out

  Rows(const std::array<glm::dvec3, 3>& corners, double spacing) {
    for (size_t c = 0; c < 3; ++c) {
      const double side = glm::length(corners[(c + 2) % 3] - corners[(c + 1) % 3]);
      if (side > longest) longest = side, apex = c, from = (c + 1) % 3, to = (c + 2) % 3;
    }
    area = 0.5 * glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    if (!(area > 0.0) || !std::isfinite(longest)) return;
    count = parts(2.0 * area / longest, spacing);
    apexAlong = std::clamp(
        glm::dot(corners[apex] - corners[from], (corners[to] - corners[from]) / longest) / longest, 0.0, 1.0);
  }
  /// Of row 0 .. count - 1, the widest first: share of the longest side at half its height.
  double widthOf(int64_t row) const { return 1.0 - (double(row) + 0.5) / double(count); }
  int64_t samplesOf(int64_t row, double spacing) const { return parts(longest * widthOf(row), spacing); }
  /// The i-th of `samples` slices of a row, of equal length along all of its longer side.
  Piece slice(int64_t row, int64_t i, int64_t samples) const {
    const double low = double(row) / double(count), high = double(row + 1) / double(count);
    const double first = apexAlong * low, length = 1.0 - low;
    const double begin = first + length * double(i) / double(samples),
                 end = first + length * double(i + 1) / double(samples);
    std::array<glm::dvec2, 8> corners = {glm::dvec2(first, low), glm::dvec2(first + length, low),
                                         glm::dvec2(1.0 - (1.0 - apexAlong) * high, high),
                                         glm::dvec2(apexAlong * high, high)};
    size_t size = clipped(corners, 4, begin, 1.0);
    size = clipped(corners, size, end, -1.0);
    return pieceOf(corners, size);
  }
  /// Keeps what has sign * (x - at) >= 0.
  static size_t clipped(std::array<glm::dvec2, 8>& corners, size_t count, double at, double sign) {
    std::array<glm::dvec2, 8> out{};
    size_t size = 0;
    for (size_t i = 0; i < count; ++i) {
      const glm::dvec2 a = corners[i], b = corners[(i + 1) % count];
      const double da = sign * (a.x - at), db = sign * (b.x - at);
      if (da >= 0.0) out[size++] = a;
      if ((da > 0.0 && db < 0.0) || (da < 0.0 && db > 0.0)) out[size++] = a + da / (da - db) * (b - a);
    }
    corners = out;
    return size;
  }

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
      for (int64_t i = 0; i < count; ++i) {
        const Piece piece = rows.count * count == 1 ? Piece{0.5, (1.0 + rows.apexAlong) / 3.0, 1.0 / 3.0}
                                                    : rows.slice(row, i, count);
        if (!(piece.area > 0.0)) continue;
        std::array<double, 3> weights{};
        weights[rows.apex] = piece.across;
        weights[rows.to] = piece.along - rows.apexAlong * piece.across;
        weights[rows.from] = 1.0 - weights[rows.apex] - weights[rows.to];
        out.push_back({static_cast<uint32_t>(t), static_cast<float>(weights[1]),
                       static_cast<float>(weights[2]), 2.0 * piece.area * rows.area});
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
