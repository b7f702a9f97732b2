// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/voxels/hausdorff.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/scene/closest_point.h"

namespace limen::voxels {
namespace {

bool isFinite(glm::dvec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

scene::Mesh finiteTriangles(const scene::Mesh& mesh) {
  scene::Mesh out;
  out.positions = mesh.positions;
  for (const glm::uvec3 t : mesh.triangles)
    if (isFinite(mesh.positions[t.x]) && isFinite(mesh.positions[t.y]) && isFinite(mesh.positions[t.z]))
      out.triangles.push_back(t);
  return out;
}

DirectedDistances directed(const std::vector<glm::dvec3>& from, const scene::Mesh& to) {
  DirectedDistances out;
  if (from.empty()) return out;
  if (to.triangles.empty()) {
    out.largest = out.mean = out.rms = std::numeric_limits<double>::infinity();
    return out;
  }
  const scene::ClosestPoint closest(to);
  double sum = 0.0, squares = 0.0;
  for (const glm::dvec3 point : from) {
    const double distance = closest.distance(point);
    out.largest = std::max(out.largest, distance);
    sum += distance, squares += distance * distance;
  }
  out.mean = sum / static_cast<double>(from.size());
  out.rms = std::sqrt(squares / static_cast<double>(from.size()));
  return out;
}

}  // namespace

HausdorffDistances hausdorff(const scene::Mesh& mesh, const VoxelGrid& grid,
                             const std::vector<uint8_t>& occupied, int samples, int64_t seed) {
  const scene::Mesh surface = finiteTriangles(mesh);
  std::vector<glm::dvec3> middles;
  scene::Mesh cloud;  // each a triangle without extent
  glm::ivec3 voxel;
  for (voxel.z = 0; voxel.z < grid.resolution.z; ++voxel.z)
    for (voxel.y = 0; voxel.y < grid.resolution.y; ++voxel.y)
      for (voxel.x = 0; voxel.x < grid.resolution.x; ++voxel.x) {
        if (!occupied[static_cast<size_t>(grid.indexOf(voxel))]) continue;
        cloud.triangles.emplace_back(static_cast<uint32_t>(middles.size()));
        middles.push_back(grid.centre(voxel));
      }
  cloud.positions = middles;
  std::vector<glm::dvec3> points = scene::pointsOnSurface(surface, samples, seed);
  std::erase_if(points, [&](glm::dvec3 point) {
    const glm::dvec3 at = grid.toVoxels(point);
    return glm::any(glm::lessThan(at, glm::dvec3(0.0))) ||
           glm::any(glm::greaterThan(at, glm::dvec3(grid.resolution)));
  });
  const size_t most = static_cast<size_t>(std::max(samples, 1)), step = (middles.size() + most - 1) / most;
  std::vector<glm::dvec3> chosen;
  for (size_t i = 0; i < middles.size(); i += std::max<size_t>(step, 1)) chosen.push_back(middles[i]);
  return {directed(chosen, surface), directed(points, cloud)};
}

}  // namespace limen::voxels
