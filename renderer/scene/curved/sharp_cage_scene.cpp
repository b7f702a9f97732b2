// SPDX-License-Identifier: BSD-3-Clause
// Control cages of subdivision surfaces, with and without sharp edges (Schwarz 2009, section 6.1.5).
#include <algorithm>

#include "renderer/scene/curved/subdivision_cages.h"
#include "renderer/scene/stage.h"
#include "renderer/surfaces/catmull_clark.h"

namespace limen::scene {
namespace {

struct SharpCageSettings {
  CageShape shape = CageShape::DoubleTorus;
  int steps = 4;
  static const SettingsTable<SharpCageSettings>& table() {
    using S = SharpCageSettings;
    static const SettingsTable<S> kTable = {
        {&S::shape, "shape",
         "Two joined rings of 48 quads; or a block of 6, whose vertices have valence 3: smooth, with sharp "
         "edges "
         "around its top and its bottom, or with two upright ones as well, whose ends are corners; or a "
         "house of a pentagon, quads and triangles",
         "Schwarz 2009, section 6.1.5"},
        {&S::steps,
         "steps",
         {0, 5},
         "steps",
         "Steps of subdivision before vertices are moved to the limit, in the mesh"}};
    return kTable;
  }
  void check() const {
    if (shape == CageShape::House && steps == 0)
      throw Error("limit points are those of quads", "steps", "a house needs a step or more");
  }
};

Scene buildSharpCage(const SharpCageSettings& settings) {
  surfaces::PolygonMesh cage = closedCage(settings.shape);
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
