// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/lod/mesh_chain.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>

#include "renderer/scene/closest_point.h"

namespace limen::scene {
namespace {

/// The vertices that `triangles` use, and the triangles with their new indices.
Mesh compacted(const Mesh& source, const std::vector<unsigned>& indices) {
  Mesh out;
  std::vector<uint32_t> moved(source.positions.size(), 0xffffffffU);
  for (size_t i = 0; i + 2 < indices.size(); i += 3) {
    glm::uvec3 triangle(indices[i], indices[i + 1], indices[i + 2]);
    for (int corner = 0; corner < 3; ++corner) {
      uint32_t& index = moved[triangle[corner]];
      if (index == 0xffffffffU) {
        index = static_cast<uint32_t>(out.positions.size());
        out.positions.push_back(source.positions[triangle[corner]]);
        if (!source.normals.empty()) out.normals.push_back(source.normals[triangle[corner]]);
      }
      triangle[corner] = index;
    }
    out.triangles.push_back(triangle);
  }
  return out;
}

struct Step {
  Mesh mesh;
  double error = 0.0;  // world units
};

Step simplified(const Mesh& mesh, size_t triangles) {
  Bounds bounds;
  for (const glm::dvec3& position : mesh.positions) bounds.extend(position);
  std::vector<glm::vec3> positions;
  for (const glm::dvec3& position : mesh.positions) positions.emplace_back(position - bounds.centre());
  std::vector<unsigned> indices;
  for (const glm::uvec3& triangle : mesh.triangles)
    indices.insert(indices.end(), {triangle.x, triangle.y, triangle.z});
  std::vector<unsigned> kept(indices.size());
  // Bounded by the triangle count only: any error relative to the mesh's extent is allowed.
  constexpr float kAnyError = 1.0F;
  float error = 0.0F;
  kept.resize(meshopt_simplify(kept.data(), indices.data(), indices.size(), &positions[0].x, positions.size(),
                               sizeof(glm::vec3), 3 * triangles, kAnyError, 0, &error));
  const double scale =
      static_cast<double>(meshopt_simplifyScale(&positions[0].x, positions.size(), sizeof(glm::vec3)));
  return {compacted(mesh, kept), static_cast<double>(error) * scale};
}

}  // namespace

std::vector<glm::vec3> vertexNormals(const Mesh& mesh) {
  std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0.0));
  for (const glm::uvec3& triangle : mesh.triangles)
    for (int corner = 0; corner < 3; ++corner) {
      const glm::dvec3 at = mesh.positions[triangle[corner]];
      const glm::dvec3 u = mesh.positions[triangle[(corner + 1) % 3]] - at,
                       v = mesh.positions[triangle[(corner + 2) % 3]] - at, n = glm::cross(u, v);
      const double twiceArea = glm::length(n);
      if (!(twiceArea > 0.0)) continue;
      sums[triangle[corner]] += std::atan2(twiceArea, glm::dot(u, v)) / twiceArea * n;
    }
  std::vector<glm::vec3> out;
  for (const glm::dvec3& sum : sums) {
    const double length = glm::length(sum);
    out.emplace_back(length > 1e-12 ? glm::vec3(sum / length) : glm::vec3(0.0F));
  }
  return out;
}

LodSet simplifiedChain(const std::string& name, const Mesh& mesh, const std::vector<double>& keptShares,
                       ChainNormals normals) {
  LodSet set;
  set.name = name;
  set.levels.push_back({mesh, 0.0, 0.0});
  if (mesh.normals.empty()) set.levels[0].mesh.normals = vertexNormals(mesh);
  for (const double share : keptShares) {
    const LodMesh& finer = set.levels.back();
    const auto wanted =
        static_cast<size_t>(std::max(1.0, std::round(share * static_cast<double>(mesh.triangles.size()))));
    if (wanted >= finer.mesh.triangles.size()) continue;
    Step step = simplified(finer.mesh, wanted);
    if (step.mesh.triangles.empty() || step.mesh.triangles.size() >= finer.mesh.triangles.size()) continue;
    if (normals == ChainNormals::Own) step.mesh.normals = vertexNormals(step.mesh);
    LodMesh level;
    level.statedError = finer.statedError + step.error;
    level.mesh = std::move(step.mesh);
    level.deviation = sampledDeviation(mesh, level.mesh);
    set.levels.push_back(std::move(level));
  }
  for (size_t i = 0; i + 1 < set.levels.size(); ++i) {
    const ClosestPoint coarser(set.levels[i + 1].mesh);
    Mesh& level = set.levels[i].mesh;
    for (const glm::dvec3& position : level.positions) level.morphTargets.push_back(coarser(position));
  }
  set.levels.back().mesh.morphTargets = set.levels.back().mesh.positions;
  return set;
}

}  // namespace limen::scene
