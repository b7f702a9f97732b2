// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/pn_set.h"

#include "renderer/surfaces/mesh_edges.h"
#include "renderer/surfaces/neighbours.h"
#include "renderer/surfaces/patch_builder.h"

namespace limen::surfaces {
namespace {

std::vector<PnBase> bases(const BaseMesh& mesh) {
  std::vector<PnBase> out(mesh.triangles.size());
  for (size_t t = 0; t < out.size(); ++t) {
    for (int c = 0; c < 3; ++c)
      out[t].positions[static_cast<size_t>(c)] = mesh.positions[mesh.triangles[t][c]];
    out[t].normals = mesh.cornerNormals[t];
  }
  return out;
}

void tagCreases(const BaseMesh& mesh, std::vector<PnBase>& out) {
  for (const MeshEdge& edge : edgesOf(mesh.triangles)) {
    if (edge.sides != 2) continue;
    for (size_t i = 0; i < 2; ++i) {
      const uint32_t t = edge.triangles[i], other = edge.triangles[1 - i];
      const glm::uvec3& own = mesh.triangles[t];
      for (uint32_t s = 0; s < 3; ++s) {
        const uint32_t a = own[static_cast<int>(s)], b = own[static_cast<int>((s + 1) % 3)];
        if (std::array{std::min(a, b), std::max(a, b)} != edge.vertices) continue;
        for (size_t end = 0; end < 2; ++end) {
          const uint32_t corner = cornerOf(mesh.triangles, other, end == 0 ? a : b);
          const glm::dvec3& theirs = mesh.cornerNormals[other][corner % 3];
          if (theirs != mesh.cornerNormals[t][(s + end) % 3]) out[t].creases[s][end] = theirs;
        }
      }
    }
  }
}

template <size_t kCount>
std::array<glm::dvec4, kCount> homogeneous(const std::array<glm::dvec3, kCount>& points) {
  std::array<glm::dvec4, kCount> out;
  for (size_t i = 0; i < kCount; ++i) out[i] = glm::dvec4(points[i], 1.0);
  return out;
}

}  // namespace

std::vector<PnBase> pnBases(const BaseMesh& mesh, bool creases) {
  std::vector<PnBase> out = bases(mesh);
  if (creases) tagCreases(mesh, out);
  return out;
}

PatchSet pnSet(const BaseMesh& mesh, const PnSetSettings& settings) {
  const std::vector<PnBase> triangles = pnBases(mesh, settings.creases);
  PatchSet set;
  for (const PnBase& base : triangles) {
    const PnTriangle patch = pnTriangle(base, settings.patch);
    addTriangle(set, 3, homogeneous(patch.points), 2, patch.normals);
  }
  findNeighbours(set);
  return set;
}

PatchSet phongSet(const BaseMesh& mesh, double alpha) {
  PatchSet set;
  for (const PnBase& base : bases(mesh)) {
    const auto& n = base.normals;
    // Linear normals in the order of a triangle of degree 1.
    addTriangle(set, 2, homogeneous(phongTriangle(base, alpha)), 1, n);
  }
  findNeighbours(set);
  return set;
}

}  // namespace limen::surfaces
