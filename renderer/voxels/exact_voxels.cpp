// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/voxels/exact_voxels.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace limen::voxels {
namespace {

struct Corners {
  glm::dvec3 at[3];
  glm::dvec3 low, high;
};

/// Calls `take` for each finite triangle near the grid, in voxels.
void forTriangles(const scene::Mesh& mesh, const VoxelGrid& grid,
                  const std::function<void(const Corners&)>& take) {
  for (const glm::uvec3 triangle : mesh.triangles) {
    Corners corners;
    bool finite = true;
    for (int i = 0; i < 3; ++i) {
      corners.at[i] = grid.toVoxels(mesh.positions[triangle[i]]);
      for (int axis = 0; axis < 3; ++axis) finite = finite && std::isfinite(corners.at[i][axis]);
    }
    if (!finite) continue;
    corners.low = glm::min(corners.at[0], glm::min(corners.at[1], corners.at[2]));
    corners.high = glm::max(corners.at[0], glm::max(corners.at[1], corners.at[2]));
    const glm::dvec3 size(grid.resolution);
    if (glm::any(glm::lessThan(corners.high, glm::dvec3(0.0))) ||
        glm::any(glm::greaterThan(corners.low, size)))
      continue;
    take(corners);
  }
}

/// First and last voxel whose closed side meets an interval.
glm::ivec2 sidesMet(double low, double high, int size) {
  return {std::clamp(static_cast<int>(std::ceil(low)) - 1, 0, size - 1),
          std::clamp(static_cast<int>(std::floor(high)), 0, size - 1)};
}

bool separates(glm::dvec3 axis, const glm::dvec3 (&corners)[3], double half) {
  double low = glm::dot(axis, corners[0]), high = low;
  for (int i = 1; i < 3; ++i) {
    const double at = glm::dot(axis, corners[i]);
    low = std::min(low, at), high = std::max(high, at);
  }
  const double reach = half * (std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z));
  return low > reach || high < -reach;
}

/// Twice the signed area of a, b, p.
double area(glm::dvec2 a, glm::dvec2 b, glm::dvec2 p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

void addMiddleLines(const Corners& corners, int axis, const VoxelGrid& grid, double margin,
                    std::vector<uint8_t>& out) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  glm::dvec2 p[3];
  for (int i = 0; i < 3; ++i) p[i] = {corners.at[i][u], corners.at[i][v]};
  const double whole = area(p[0], p[1], p[2]);
  if (whole == 0.0) return;
  const auto firstMiddle = [](double low) { return std::max(0, static_cast<int>(std::ceil(low - 0.5))); };
  const auto lastMiddle = [](double high, int size) {
    return std::min(size - 1, static_cast<int>(std::floor(high - 0.5)));
  };
  glm::ivec3 voxel;
  for (voxel[v] = firstMiddle(corners.low[v]); voxel[v] <= lastMiddle(corners.high[v], grid.resolution[v]);
       ++voxel[v])
    for (voxel[u] = firstMiddle(corners.low[u]); voxel[u] <= lastMiddle(corners.high[u], grid.resolution[u]);
         ++voxel[u]) {
      const glm::dvec2 middle{voxel[u] + 0.5, voxel[v] + 0.5};
      const double weights[3] = {area(p[1], p[2], middle) / whole, area(p[2], p[0], middle) / whole,
                                 area(p[0], p[1], middle) / whole};
      if (std::min({weights[0], weights[1], weights[2]}) < 0.0) continue;
      const double at = weights[0] * corners.at[0][axis] + weights[1] * corners.at[1][axis] +
                        weights[2] * corners.at[2][axis];
      if (!(at >= 0.0 && at < grid.resolution[axis])) continue;
      voxel[axis] = static_cast<int>(at);
      const double within = at - voxel[axis];
      if (within > margin && within < 1.0 - margin) out[static_cast<size_t>(grid.indexOf(voxel))] = 1;
    }
}

}  // namespace

bool meetsVoxel(const glm::dvec3 (&corners)[3], glm::ivec3 voxel, double slack) {
  const double half = 0.5 + slack;
  const glm::dvec3 middle = glm::dvec3(voxel) + 0.5;
  const glm::dvec3 at[3] = {corners[0] - middle, corners[1] - middle, corners[2] - middle};
  const glm::dvec3 edges[3] = {at[1] - at[0], at[2] - at[1], at[0] - at[2]};
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 along(0.0);
    along[axis] = 1.0;
    if (separates(along, at, half)) return false;
    for (const glm::dvec3& edge : edges)
      if (separates(glm::cross(along, edge), at, half)) return false;
  }
  return !separates(glm::cross(edges[0], edges[1]), at, half);
}

std::vector<uint8_t> exactVoxels(const scene::Mesh& mesh, const VoxelGrid& grid, double slack) {
  std::vector<uint8_t> out(static_cast<size_t>(grid.count()));
  forTriangles(mesh, grid, [&](const Corners& corners) {
    glm::ivec2 range[3];
    for (int axis = 0; axis < 3; ++axis)
      range[axis] = sidesMet(corners.low[axis] - slack, corners.high[axis] + slack, grid.resolution[axis]);
    for (int z = range[2].x; z <= range[2].y; ++z)
      for (int y = range[1].x; y <= range[1].y; ++y)
        for (int x = range[0].x; x <= range[0].y; ++x) {
          uint8_t& voxel = out[static_cast<size_t>(grid.indexOf({x, y, z}))];
          if (!voxel && meetsVoxel(corners.at, {x, y, z}, slack)) voxel = 1;
        }
  });
  return out;
}

std::vector<uint8_t> separatingVoxels(const scene::Mesh& mesh, const VoxelGrid& grid, double margin) {
  std::vector<uint8_t> out(static_cast<size_t>(grid.count()));
  forTriangles(mesh, grid, [&](const Corners& corners) {
    for (int axis = 0; axis < 3; ++axis) addMiddleLines(corners, axis, grid, margin, out);
  });
  return out;
}

SetDifference compare(const std::vector<uint8_t>& found, const std::vector<uint8_t>& expected) {
  SetDifference out;
  for (size_t i = 0; i < found.size(); ++i) {
    if (expected[i] && !found[i]) ++out.missing;
    if (found[i] && !expected[i]) ++out.extra;
  }
  return out;
}

int64_t countOf(const std::vector<uint8_t>& voxels) { return std::count(voxels.begin(), voxels.end(), 1); }

}  // namespace limen::voxels
