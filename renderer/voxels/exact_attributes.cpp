// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/voxels/exact_attributes.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "experiments/base/image.h"
#include "renderer/voxels/exact_voxels.h"

namespace limen::voxels {
namespace {

/// Of the part of a triangle within a voxel, twice the area times the normal.
glm::dvec3 areaWithin(const glm::dvec3 (&corners)[3], glm::ivec3 voxel) {
  std::vector<glm::dvec3> polygon(corners, corners + 3), kept;
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {0, 1}) {
      const double plane = voxel[axis] + side, outwards = side == 0 ? -1.0 : 1.0;
      kept.clear();
      for (size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double outA = outwards * (a[axis] - plane), outB = outwards * (b[axis] - plane);
        if (outA <= 0.0) kept.push_back(a);
        if ((outA < 0.0 && outB > 0.0) || (outA > 0.0 && outB < 0.0))
          kept.push_back(a + outA / (outA - outB) * (b - a));
      }
      polygon.swap(kept);
      if (polygon.size() < 3) return glm::dvec3(0.0);
    }
  glm::dvec3 sum(0.0);
  for (size_t i = 2; i < polygon.size(); ++i)
    sum += glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return sum;
}

void addTriangle(const glm::dvec3 (&corners)[3], glm::dvec3 albedo, const VoxelGrid& grid,
                 std::unordered_map<int64_t, ExactAttributes>& out) {
  glm::dvec3 low = corners[0], high = corners[0];
  for (const glm::dvec3& corner : corners) low = glm::min(low, corner), high = glm::max(high, corner);
  if (!std::isfinite(glm::dot(low + high, glm::dvec3(1.0)))) return;
  const glm::ivec3 most = grid.resolution - 1;
  const glm::ivec3 first(glm::clamp(glm::floor(low), glm::dvec3(0.0), glm::dvec3(most))),
      last(glm::clamp(glm::floor(high), glm::dvec3(0.0), glm::dvec3(most)));
  for (int z = first.z; z <= last.z; ++z)
    for (int y = first.y; y <= last.y; ++y)
      for (int x = first.x; x <= last.x; ++x) {
        if (!meetsVoxel(corners, {x, y, z})) continue;
        const glm::dvec3 within = areaWithin(corners, {x, y, z});
        const double area = 0.5 * glm::length(within);
        if (area == 0.0) continue;
        ExactAttributes& voxel = out[grid.indexOf({x, y, z})];
        voxel.area += area;
        voxel.normal += 0.5 * within;
        voxel.albedo += area * albedo;
      }
}

}  // namespace

std::unordered_map<int64_t, ExactAttributes> exactAttributes(const scene::Scene& scene,
                                                             const scene::Mesh& mesh, const VoxelGrid& grid) {
  std::unordered_map<int64_t, ExactAttributes> out;
  for (const scene::Part& part : scene.parts)
    for (uint32_t i = part.firstTriangle; i < part.firstTriangle + part.triangleCount; ++i) {
      const glm::uvec3 triangle = mesh.triangles[i];
      const glm::dvec3 corners[3] = {grid.toVoxels(mesh.positions[triangle.x]),
                                     grid.toVoxels(mesh.positions[triangle.y]),
                                     grid.toVoxels(mesh.positions[triangle.z])};
      addTriangle(corners, glm::dvec3(scene.materials[part.material].albedo), grid, out);
    }
  for (auto& [index, voxel] : out) {
    voxel.normal /= voxel.area;
    voxel.albedo /= voxel.area;
  }
  return out;
}

AttributeError compare(const Volume& volume, const std::unordered_map<int64_t, ExactAttributes>& exact) {
  AttributeError out;
  double albedoSum = 0.0, angleSum = 0.0;
  const VoxelGrid& grid = volume.grid();
  for (int z = 0; z < grid.resolution.z; ++z) {
    const Image albedo = volume.albedo().readLayer(z), normal = volume.normal().readLayer(z);
    for (int y = 0; y < grid.resolution.y; ++y)
      for (int x = 0; x < grid.resolution.x; ++x) {
        const auto found = exact.find(grid.indexOf({x, y, z}));
        if (found == exact.end() || albedo.at(x, y, 3) == 0.0F) continue;
        ++out.voxels;
        glm::dvec3 mean;
        for (int c = 0; c < 3; ++c) {
          const double off = albedo.at(x, y, c) - found->second.albedo[c];
          albedoSum += off * off;
          mean[c] = normal.at(x, y, c);
        }
        if (std::min(glm::length(mean), glm::length(found->second.normal)) < 0.1) continue;
        ++out.normals;
        const double cosine = glm::dot(glm::normalize(mean), glm::normalize(found->second.normal));
        const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
        angleSum += angle * angle;
      }
  }
  if (out.voxels > 0) out.albedo = std::sqrt(albedoSum / (3.0 * static_cast<double>(out.voxels)));
  if (out.normals > 0) out.normalDeg = glm::degrees(std::sqrt(angleSum / static_cast<double>(out.normals)));
  return out;
}

}  // namespace limen::voxels
