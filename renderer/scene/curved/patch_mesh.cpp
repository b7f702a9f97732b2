// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/curved/patch_mesh.h"

#include "renderer/scene/stage.h"
#include "renderer/surfaces/neighbours.h"
#include "renderer/surfaces/patch_builder.h"
#include "renderer/surfaces/trim_test.h"

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

/// Cells of a trimmed rectangle, cut where a curve crosses their edges: at most once each, so that what is
/// smaller than a cell may be lost.
class TrimmedGrid {
 public:
  TrimmedGrid(Mesh& mesh, VertexWriter& writer, const surfaces::TrimTest& test, uint32_t patch)
      : mesh_(mesh), writer_(writer), test_(test), patch_(patch) {}
  void add(int factor) {
    for (int j = 0; j < factor; ++j)
      for (int i = 0; i < factor; ++i) {
        const auto corner = [&](int x, int y) {
          return surfaces::rectangleGridPoint(i + x, factor, j + y, factor);
        };
        addCut({corner(0, 0), corner(1, 0), corner(1, 1)});
        addCut({corner(0, 0), corner(1, 1), corner(0, 1)});
      }
  }

 private:
  static DomainPoint between(const DomainPoint& a, const DomainPoint& b, double t) {
    const auto mixed = [&](double x, double y) { return (1.0 - t) * x + t * y; };
    return {mixed(a.u, b.u), mixed(a.v, b.v), mixed(a.restU, b.restU), mixed(a.restV, b.restV)};
  }
  /// Last place on the way from `inside` to `outside` that is left.
  DomainPoint crossing(const DomainPoint& inside, const DomainPoint& outside) const {
    double low = 0.0, high = 1.0;
    for (int step = 0; step < 40; ++step) {
      const double middle = 0.5 * (low + high);
      (test_.isLeft(patch_, between(inside, outside, middle)) ? low : high) = middle;
    }
    return between(inside, outside, low);
  }
  void addCut(const std::array<DomainPoint, 3>& corners) {
    const auto first = static_cast<uint32_t>(mesh_.positions.size());
    uint32_t count = 0;
    for (size_t k = 0; k < 3; ++k) {
      const DomainPoint &a = corners[k], &b = corners[(k + 1) % 3];
      const bool left = test_.isLeft(patch_, a), next = test_.isLeft(patch_, b);
      if (left) writer_.add(a), ++count;
      if (left != next) writer_.add(left ? crossing(a, b) : crossing(b, a)), ++count;
    }
    for (uint32_t k = 1; k + 1 < count; ++k) addTriangleUnlessThin(mesh_, {first, first + k, first + k + 1});
  }

  Mesh& mesh_;
  VertexWriter& writer_;
  const surfaces::TrimTest& test_;
  uint32_t patch_;
};

}  // namespace

Mesh patchMesh(const surfaces::PatchSet& set, int factor, surfaces::NormalHistogram* histogram) {
  Mesh mesh;
  const surfaces::TrimTest trims(set);
  for (uint32_t number = 0; number < set.patches.size(); ++number) {
    const surfaces::Patch& patch = set.patches[number];
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    const bool rectangle = patch.domain == Domain::Rectangle;
    VertexWriter writer(mesh, set, patch, histogram);
    if (!set.trimOf.empty() && set.trimOf[number].region >= 0) {
      TrimmedGrid(mesh, writer, trims, number).add(factor);
      continue;
    }
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
  addPart(scene, name, patchMesh(surfaces::movedTo(set, 0.0), factor), albedo);
  surfaces::append(scene.surfaces, set);
}

}  // namespace limen::scene
