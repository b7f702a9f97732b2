// SPDX-License-Identifier: BSD-3-Clause
// Control cages of subdivision surfaces, with and without sharp edges (Schwarz 2009, section 6.1.5).
#include <algorithm>

#include "renderer/scene/curved/double_torus.h"
#include "renderer/scene/stage.h"
#include "renderer/surfaces/catmull_clark.h"

namespace limen::scene {
namespace {

enum class CageShape { DoubleTorus, Block, CreasedBlock, CorneredBlock };
constexpr EnumNames<CageShape, 4> enumNames(CageShape) {
  return {{{{CageShape::Block, "block"},
            {CageShape::CorneredBlock, "cornered_block"},
            {CageShape::CreasedBlock, "creased_block"},
            {CageShape::DoubleTorus, "double_torus"}}}};
}

struct SharpCageSettings {
  CageShape shape = CageShape::DoubleTorus;
  int steps = 4;
  static const SettingsTable<SharpCageSettings>& table() {
    using S = SharpCageSettings;
    static const SettingsTable<S> kTable = {
        {&S::shape, "shape",
         "Two joined rings of 48 quads; or a block of 6, whose vertices have valence 3: smooth, with sharp "
         "edges "
         "around its top and its bottom, or with two upright ones as well, whose ends are corners",
         "Schwarz 2009, section 6.1.5"},
        {&S::steps,
         "steps",
         {0, 5},
         "steps",
         "Steps of subdivision before vertices are moved to the limit, in the mesh"}};
    return kTable;
  }
};

surfaces::PolygonMesh block() {
  surfaces::PolygonMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.points.emplace_back(i & 1 ? 0.6 : -0.6, i & 2 ? 1.0 : 0.0, i & 4 ? 0.45 : -0.45);
  mesh.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return mesh;
}

/// Vertices are numbered by their coordinates: bit 1 is up.
void sharpen(surfaces::PolygonMesh& mesh, bool corners) {
  const auto edge = [&](uint32_t a, uint32_t b) {
    mesh.sharpness[surfaces::edgeKey(a, b)] = surfaces::kInfinitelySharp;
  };
  for (const uint32_t level : {0U, 2U}) {
    edge(level, level + 1), edge(level + 1, level + 5);
    edge(level + 5, level + 4), edge(level + 4, level);
  }
  if (corners) edge(0, 2), edge(5, 7);
}

surfaces::PolygonMesh sharpCageOf(CageShape shape) {
  surfaces::PolygonMesh mesh;
  if (shape == CageShape::DoubleTorus) {
    mesh = doubleTorusCage();
    for (glm::dvec3& p : mesh.points) p = {p.x, -p.z, p.y};
    return mesh;
  }
  mesh = block();
  if (shape != CageShape::Block) sharpen(mesh, shape == CageShape::CorneredBlock);
  return mesh;
}

Scene buildSharpCage(const SharpCageSettings& settings) {
  surfaces::PolygonMesh cage = sharpCageOf(settings.shape);
  Bounds bounds;
  for (const glm::dvec3& p : cage.points) bounds.extend(p);
  const double scale = 1.0 / (bounds.high.y - bounds.low.y);
  for (glm::dvec3& p : cage.points)
    p = scale * (p - glm::dvec3(0.0, bounds.low.y, 0.0)) + glm::dvec3(0.0, 0.01, 0.0);
  const surfaces::PolygonMesh fine = surfaces::catmullClark(cage, settings.steps);
  const surfaces::LimitPoints limit = surfaces::catmullClarkLimit(fine);
  Mesh mesh;
  for (size_t f = 0; f < fine.faces.size(); ++f) {
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (size_t k = 0; k < 4; ++k) {
      mesh.positions.push_back(limit.points[fine.faces[f][k]]);
      mesh.normals.emplace_back(limit.normals[f][k]);
    }
    mesh.triangles.insert(mesh.triangles.end(),
                          {{first, first + 1, first + 2}, {first, first + 2, first + 3}});
  }
  Scene scene;
  const double reach = scale * std::max(bounds.high.x, bounds.high.z);
  addGround(scene, 8.0 * reach);
  surfaces::SubdivisionSurface surface;
  surface.cage = std::move(cage);
  surface.scheme = surfaces::SubdivisionScheme::CatmullClark;
  surface.part = static_cast<uint32_t>(scene.parts.size());
  addPart(scene, "surface", mesh, {0.62F, 0.58F, 0.66F});
  scene.subdivisions.push_back(std::move(surface));
  frameStanding(scene, 1.0, reach);
  return scene;
}

const RegisteredScene<SharpCageSettings> kSharpCage{
    {.name = "curved/sharp_cage",
     .version = 1,
     .summary = "Subdivision surface of a control cage, smooth or with creases and corners",
     .source = "Schwarz 2009, section 6.1.5"},
    buildSharpCage};

}  // namespace
}  // namespace limen::scene
