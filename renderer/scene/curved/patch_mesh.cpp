// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/curved/patch_mesh.h"

#include "renderer/scene/stage.h"
#include "renderer/surfaces/neighbours.h"
#include "renderer/surfaces/patch_builder.h"

namespace limen::scene {
namespace {

using surfaces::Domain;
using surfaces::DomainPoint;

void addVertex(Mesh& mesh, const surfaces::PatchSet& set, const surfaces::Patch& patch, const DomainPoint& at,
               surfaces::NormalHistogram* histogram) {
  mesh.positions.push_back(surfaces::evaluate(set, patch, at, surfaces::Order::Position).p);
  const surfaces::SurfaceNormal normal = surfaces::normalAt(set, patch, at);
  mesh.normals.emplace_back(normal.direction);
  if (histogram) ++(*histogram)[static_cast<size_t>(normal.rung)];
}

void addTriangleUnlessThin(Mesh& mesh, glm::uvec3 t) {
  const glm::dvec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
  if (a != b && b != c && c != a) mesh.triangles.push_back(t);
}

/// Vertices in rows of constant v.
void addRectangleGrid(Mesh& mesh, uint32_t first, uint32_t factor) {
  const uint32_t row = factor + 1;
  for (uint32_t j = 0; j < factor; ++j)
    for (uint32_t i = 0; i < factor; ++i) {
      const uint32_t a = first + i + row * j;
      addTriangleUnlessThin(mesh, {a, a + 1, a + row + 1});
      addTriangleUnlessThin(mesh, {a, a + row + 1, a + row});
    }
}

/// Vertices in rows of constant v, each one shorter than the one before.
void addTriangleGrid(Mesh& mesh, uint32_t first, uint32_t factor) {
  for (uint32_t j = 0, start = first; j < factor; ++j) {
    const uint32_t length = factor + 1 - j, above = start + length;
    for (uint32_t i = 0; i + 1 < length; ++i) {
      addTriangleUnlessThin(mesh, {start + i, start + i + 1, above + i});
      if (i + 2 < length) addTriangleUnlessThin(mesh, {start + i + 1, above + i + 1, above + i});
    }
    start = above;
  }
}

}  // namespace

Mesh patchMesh(const surfaces::PatchSet& set, int factor, surfaces::NormalHistogram* histogram) {
  Mesh mesh;
  for (const surfaces::Patch& patch : set.patches) {
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    const bool rectangle = patch.domain == Domain::Rectangle;
    for (int j = 0; j <= factor; ++j)
      for (int i = 0; i <= (rectangle ? factor : factor - j); ++i)
        addVertex(mesh, set, patch,
                  rectangle ? surfaces::rectangleGridPoint(i, factor, j, factor)
                            : surfaces::triangleGridPoint(i, j, factor),
                  histogram);
    if (rectangle)
      addRectangleGrid(mesh, first, static_cast<uint32_t>(factor));
    else
      addTriangleGrid(mesh, first, static_cast<uint32_t>(factor));
  }
  return mesh;
}

void addSurface(Scene& scene, const std::string& name, surfaces::PatchSet set, int factor, glm::vec3 albedo) {
  surfaces::findNeighbours(set);
  for (surfaces::Patch& patch : set.patches) patch.part = static_cast<uint32_t>(scene.parts.size());
  addPart(scene, name, patchMesh(set, factor), albedo);
  surfaces::append(scene.surfaces, set);
}

}  // namespace limen::scene
