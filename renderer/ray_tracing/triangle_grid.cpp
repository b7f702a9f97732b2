// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/ray_tracing/triangle_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "renderer/ray_tracing/ray_tracing_bindings.h"

namespace limen::ray_tracing {
namespace {

constexpr int kMostCells = 256;
/// Share of a cell by which triangles reach farther than they do, so that a ray that rounding takes through
/// the neighbour of a cell's border finds them.
constexpr float kReach = 1e-3F;

struct GridTriangle {
  glm::vec3 a, b, c;
  glm::vec3 low() const { return glm::min(a, glm::min(b, c)); }
  glm::vec3 high() const { return glm::max(a, glm::max(b, c)); }
};

/// Whether the triangle's plane passes a box.
bool planeMeets(const GridTriangle& t, glm::dvec3 centre, glm::dvec3 half) {
  const glm::dvec3 a(t.a), normal = glm::cross(glm::dvec3(t.b) - a, glm::dvec3(t.c) - a);
  return std::abs(glm::dot(normal, centre - a)) <= glm::dot(glm::abs(normal), half);
}

}  // namespace

TriangleGrid::Sorted TriangleGrid::sorted(const std::vector<glm::vec3>& vertices,
                                          const std::vector<glm::uvec3>& triangles, double density) {
  Sorted grid;
  std::vector<GridTriangle> each;
  glm::vec3 low(3e38F), high(-3e38F);
  for (uint32_t i = 0; i < triangles.size(); ++i) {
    const GridTriangle t{vertices[triangles[i].x], vertices[triangles[i].y], vertices[triangles[i].z]};
    const glm::vec3 across = glm::cross(t.b - t.a, t.c - t.a);
    if (!(glm::dot(across, across) > 0.0F) || !std::isfinite(glm::dot(across, across))) continue;
    each.push_back(t);
    grid.triangles.emplace_back(t.a, std::bit_cast<float>(i));
    grid.triangles.emplace_back(t.b, 0.0F);
    grid.triangles.emplace_back(t.c, 0.0F);
    low = glm::min(low, t.low()), high = glm::max(high, t.high());
  }
  if (each.empty()) {
    grid.cells = {0}, grid.triangles = {glm::vec4(0.0F)};
    return grid;
  }
  const float longest = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  const glm::vec3 pad(0.01F * longest);
  low -= pad, high += pad;
  const glm::dvec3 extent(high - low);
  const double edge = std::cbrt(extent.x * extent.y * extent.z / (density * double(each.size())));
  for (int axis = 0; axis < 3; ++axis)
    grid.size[axis] = std::clamp(static_cast<int>(std::lround(extent[axis] / edge)), 1, kMostCells);
  grid.low = low, grid.cell = (high - low) / glm::vec3(grid.size);

  const auto forCells = [&](const GridTriangle& t, const auto& work) {
    const glm::vec3 reach = kReach * grid.cell;
    const glm::ivec3 from =
        glm::clamp(glm::ivec3((t.low() - reach - low) / grid.cell), glm::ivec3(0), grid.size - 1);
    const glm::ivec3 to =
        glm::clamp(glm::ivec3((t.high() + reach - low) / grid.cell), glm::ivec3(0), grid.size - 1);
    const glm::dvec3 half = (0.5 + double{kReach}) * glm::dvec3(grid.cell);
    for (int z = from.z; z <= to.z; ++z)
      for (int y = from.y; y <= to.y; ++y)
        for (int x = from.x; x <= to.x; ++x)
          if (planeMeets(t, glm::dvec3(low) + (glm::dvec3(x, y, z) + 0.5) * glm::dvec3(grid.cell), half))
            work(static_cast<size_t>((z * grid.size.y + y) * grid.size.x + x));
  };
  const auto count =
      static_cast<size_t>(grid.size.x) * static_cast<size_t>(grid.size.y) * static_cast<size_t>(grid.size.z);
  std::vector<uint32_t> next(count + 1, 0);
  for (const GridTriangle& t : each) forCells(t, [&](size_t cell) { ++next[cell + 1]; });
  for (size_t cell = 0; cell < count; ++cell) next[cell + 1] += next[cell];
  grid.cells = next;
  grid.cells.resize(count + 1 + next[count]);
  for (uint32_t i = 0; i < each.size(); ++i)
    forCells(each[i], [&](size_t cell) { grid.cells[count + 1 + next[cell]++] = i; });
  return grid;
}

TriangleGrid::TriangleGrid(gl::Context& context, const Sorted& grid)
    : mostIterations_(context.device().software ? 60000 : 0x7fffffff),
      low_(grid.low),
      cell_(grid.cell),
      size_(grid.size),
      cells_(grid.cells),
      triangles_(grid.triangles) {}

TriangleGrid::TriangleGrid(gl::Context& context, const std::vector<glm::vec3>& vertices,
                           const std::vector<glm::uvec3>& triangles, double density)
    : TriangleGrid(context, sorted(vertices, triangles, density)) {}

void TriangleGrid::bind(const gl::Program& program) const {
  cells_.bindStorage(kRayNodesBuffer);
  triangles_.bindStorage(kRayTrianglesBuffer);
  program.set("rayNodeCount", static_cast<uint32_t>(size_.x * size_.y * size_.z));
  program.set("maxRayIterations", mostIterations_);
  program.set("rayGridLow", low_);
  program.set("rayGridCell", cell_);
  program.set("rayGridSize", glm::vec3(size_));
}

}  // namespace limen::ray_tracing
