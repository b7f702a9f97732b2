// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/curved/patch_mesh.h"

#include "renderer/scene/stage.h"
#include "renderer/surfaces/neighbours.h"
#include "renderer/surfaces/patch_builder.h"

namespace limen::scene {
namespace {

using surfaces::Domain;
using surfaces::DomainPoint;

/// Whether the point lies on a side of the domain; side numbers as in patch_set.h.
bool onSide(Domain domain, const DomainPoint& at, int side) {
  const std::array<double, 4> rectangle = {at.v, at.restU, at.restV, at.u},
                              triangle = {at.w(), at.u, at.v, 1.0};
  return (domain == Domain::Rectangle ? rectangle : triangle)[static_cast<size_t>(side)] == 0.0;
}

/// Adds the vertices of one patch. Those of a collapsed side lie exactly in one place.
class VertexWriter {
 public:
  VertexWriter(Mesh& mesh, const surfaces::PatchSet& set, const surfaces::Patch& patch,
               surfaces::NormalHistogram* histogram)
      : mesh_(mesh), set_(set), patch_(patch), histogram_(histogram) {
    for (int side = 0; side < sidesOf(patch.domain); ++side)
      if (surfaces::isCollapsed(set, patch, side)) collapsed_.push_back(side);
  }
  void add(const DomainPoint& at) {
    DomainPoint place = at;
    for (const int side : collapsed_)
      if (onSide(patch_.domain, at, side)) place = surfaces::sidePoint(patch_.domain, side, 0, 1);
    mesh_.positions.push_back(surfaces::evaluate(set_, patch_, place, surfaces::Order::Position).p);
    const surfaces::SurfaceNormal normal = surfaces::normalAt(set_, patch_, at);
    mesh_.normals.emplace_back(normal.direction);
    if (histogram_) ++(*histogram_)[static_cast<size_t>(normal.rung)];
  }

 private:
  Mesh& mesh_;
  const surfaces::PatchSet& set_;
  const surfaces::Patch& patch_;
  surfaces::NormalHistogram* histogram_;
  std::vector<int> collapsed_;
};

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
    VertexWriter writer(mesh, set, patch, histogram);
    for (int j = 0; j <= factor; ++j)
      for (int i = 0; i <= (rectangle ? factor : factor - j); ++i)
        writer.add(rectangle ? surfaces::rectangleGridPoint(i, factor, j, factor)
                             : surfaces::triangleGridPoint(i, j, factor));
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
