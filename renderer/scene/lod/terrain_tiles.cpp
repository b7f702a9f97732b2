// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/lod/terrain_tiles.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace limen::scene {
namespace {

/// Height of the surface that takes every stride-th point, at point (i, j); cells are cut from (0, 0) to (1,
/// 1).
double coarseHeight(const HeightField& field, int stride, int i, int j) {
  const int a = std::min(i / stride * stride, field.side - 1 - stride),
            b = std::min(j / stride * stride, field.side - 1 - stride);
  const double x = double(i - a) / stride, y = double(j - b) / stride;
  const double low = field.at(a, b), high = field.at(a + stride, b + stride);
  return y <= x ? low * (1.0 - x) + field.at(a + stride, b) * (x - y) + high * y
                : low * (1.0 - y) + field.at(a, b + stride) * (y - x) + high * x;
}

/// One tile of one level under construction.
class Tile {
 public:
  Tile(const HeightField& field, const std::vector<Aperture>& apertures, int firstI, int firstJ, int cells,
       int stride, int nextStride)
      : field_(field),
        apertures_(apertures),
        firstI_(firstI),
        firstJ_(firstJ),
        stride_(stride),
        nextStride_(nextStride),
        row_(cells / stride + 1) {
    for (int j = 0; j < row_; ++j)
      for (int i = 0; i < row_; ++i) add(i, j, 0.0);
    for (int j = 0; j + 1 < row_; ++j)
      for (int i = 0; i + 1 < row_; ++i) {
        const uint32_t a = index(i, j), b = index(i + 1, j), c = index(i + 1, j + 1), d = index(i, j + 1);
        // z grows with j: counter-clockwise from above is a, c, b.
        mesh_.triangles.emplace_back(a, c, b);
        mesh_.triangles.emplace_back(a, d, c);
      }
  }

  /// Hangs a strip of the given depth from the side that starts at grid place `from` and runs along `step`.
  void skirt(glm::ivec2 from, glm::ivec2 step, double depth) {
    const auto first = static_cast<uint32_t>(mesh_.positions.size());
    for (int k = 0; k < row_; ++k) add(from.x + k * step.x, from.y + k * step.y, depth);
    for (int k = 0; k + 1 < row_; ++k) {
      const uint32_t a = index(from.x + k * step.x, from.y + k * step.y),
                     b = index(from.x + (k + 1) * step.x, from.y + (k + 1) * step.y),
                     c = first + static_cast<uint32_t>(k), d = c + 1;
      mesh_.triangles.emplace_back(a, b, d);
      mesh_.triangles.emplace_back(a, d, c);
    }
  }

  int last() const { return row_ - 1; }
  Mesh take() { return std::move(mesh_); }

 private:
  uint32_t index(int i, int j) const { return static_cast<uint32_t>(j * row_ + i); }

  void add(int i, int j, double below) {
    const int fi = firstI_ + i * stride_, fj = firstJ_ + j * stride_;
    glm::dvec3 position = field_.point(fi, fj), target = position;
    target.y = coarseHeight(field_, nextStride_, fi, fj);
    position.y -= below, target.y -= below;
    mesh_.positions.push_back(position);
    mesh_.morphTargets.push_back(target);
    mesh_.normals.emplace_back(field_.normal(fi, fj));
    const Aperture& aperture =
        apertures_[static_cast<size_t>(fj) * static_cast<size_t>(field_.side) + static_cast<size_t>(fi)];
    mesh_.attributes.emplace_back(glm::vec3(aperture.axis), static_cast<float>(aperture.angleRad));
  }

  const HeightField& field_;
  const std::vector<Aperture>& apertures_;
  int firstI_, firstJ_, stride_, nextStride_, row_;
  Mesh mesh_;
};

/// Largest difference of height from the finest within a tile.
double tileDeviation(const HeightField& field, int firstI, int firstJ, int cells, int stride) {
  double largest = 0.0;
  for (int j = firstJ; j <= firstJ + cells; ++j)
    for (int i = firstI; i <= firstI + cells; ++i)
      largest = std::max(largest, std::abs(coarseHeight(field, stride, i, j) - field.at(i, j)));
  return largest;
}

}  // namespace

std::vector<LodSet> terrainTiles(const HeightField& field, const std::vector<Aperture>& apertures,
                                 const TileSetting& setting) {
  assert(field.side == setting.tiles * setting.cells + 1);
  assert(setting.cells % (1 << (setting.levels - 1)) == 0);
  const auto strideOf = [&](int level) { return 1 << std::min(level, setting.levels - 1); };
  // [tile][level]
  std::vector<std::vector<double>> deviations;
  double worst = 0.0;
  for (int tj = 0; tj < setting.tiles; ++tj)
    for (int ti = 0; ti < setting.tiles; ++ti) {
      deviations.emplace_back();
      for (int level = 0; level < setting.levels; ++level) {
        deviations.back().push_back(
            tileDeviation(field, ti * setting.cells, tj * setting.cells, setting.cells, strideOf(level)));
        worst = std::max(worst, deviations.back().back());
      }
    }
  std::vector<LodSet> out;
  for (int tj = 0; tj < setting.tiles; ++tj)
    for (int ti = 0; ti < setting.tiles; ++ti) {
      LodSet set;
      set.name = "tile_" + std::to_string(ti) + "_" + std::to_string(tj);
      const std::vector<double>& own = deviations[out.size()];
      for (int level = 0; level < setting.levels; ++level) {
        Tile tile(field, apertures, ti * setting.cells, tj * setting.cells, setting.cells, strideOf(level),
                  strideOf(level + 1));
        if (setting.skirts) {
          // From this surface to the finest, and on to whatever the neighbour shows; a tenth more for
          // rounding.
          const double depth = 1.1 * (own[static_cast<size_t>(level)] + worst) + 1e-3 * field.spacing;
          const int last = tile.last();
          if (ti > 0) tile.skirt({0, 0}, {0, 1}, depth);
          if (ti + 1 < setting.tiles) tile.skirt({last, last}, {0, -1}, depth);
          if (tj > 0) tile.skirt({last, 0}, {-1, 0}, depth);
          if (tj + 1 < setting.tiles) tile.skirt({0, last}, {1, 0}, depth);
        }
        const auto end = own.begin() + level + 1;
        set.levels.push_back({tile.take(), *(end - 1), *std::max_element(own.begin(), end)});
      }
      out.push_back(std::move(set));
    }
  return out;
}

}  // namespace limen::scene
