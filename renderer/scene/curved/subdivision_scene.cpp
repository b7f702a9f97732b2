// SPDX-License-Identifier: BSD-3-Clause
// Subdivision surfaces by the patches that approximate them (Schwarz 2009, section 6.1.5).
#include "renderer/scene/curved/double_torus.h"
#include "renderer/scene/curved/patch_mesh.h"
#include "renderer/scene/stage.h"
#include "renderer/surfaces/acc_patches.h"
#include "renderer/surfaces/c_patches.h"
#include "renderer/surfaces/catmull_clark.h"
#include "renderer/surfaces/loop_subdivision.h"
#include "renderer/surfaces/patch_builder.h"
#include "renderer/surfaces/qas_patches.h"

namespace limen::scene {
namespace {

enum class Approximation { Acc, AccTangents, CPatches, Qas };
constexpr EnumNames<Approximation, 4> enumNames(Approximation) {
  return {{{{Approximation::Acc, "acc"},
            {Approximation::AccTangents, "acc_tangents"},
            {Approximation::CPatches, "c_patches"},
            {Approximation::Qas, "qas"}}}};
}

struct SubdivisionSettings {
  Approximation approximation = Approximation::Acc;
  int steps = 1, tessellation = 8;
  static const SettingsTable<SubdivisionSettings>& table() {
    using S = SubdivisionSettings;
    static const SettingsTable<S> kTable = {
        {&S::approximation, "approximation",
         "Bicubic patches over the quads of Catmull-Clark's surface, shaded with their own normals or "
         "with those of tangent patches (Loop and Schaefer 2008); four quartic triangles for each quad that "
         "join smoothly (Myles, Yeo "
         "and Peters 2008); or quadratic "
         "triangles "
         "through points of Loop's (Boubekeur and Schlick 2007)"},
        {&S::steps, "steps", {0, 4}, "steps", "Steps of subdivision before each face becomes a patch"},
        {&S::tessellation,
         "tessellation",
         {1, 32},
         "segments",
         "Segments along each side of a patch in the mesh"}};
    return kTable;
  }
};

/// Every quad in two.
surfaces::PolygonMesh triangulated(surfaces::PolygonMesh mesh) {
  std::vector<std::vector<uint32_t>> triangles;
  for (const std::vector<uint32_t>& f : mesh.faces) {
    triangles.push_back({f[0], f[1], f[2]});
    triangles.push_back({f[0], f[2], f[3]});
  }
  mesh.faces = std::move(triangles);
  return mesh;
}

surfaces::PatchSet approximated(surfaces::PolygonMesh cage, const SubdivisionSettings& settings) {
  if (settings.approximation == Approximation::Qas)
    return surfaces::qasPatches(surfaces::loop(triangulated(std::move(cage)), settings.steps));
  const surfaces::PolygonMesh mesh = surfaces::catmullClark(std::move(cage), settings.steps);
  if (settings.approximation == Approximation::CPatches) return surfaces::cPatches(mesh);
  return surfaces::accPatches(mesh, settings.approximation == Approximation::AccTangents
                                        ? surfaces::AccNormals::TangentPatches
                                        : surfaces::AccNormals::Geometry);
}

/// Stands upright, 1 high, as curved/double_torus.
Scene buildSubdivision(const SubdivisionSettings& settings) {
  surfaces::PolygonMesh cage = doubleTorusCage();
  for (glm::dvec3& p : cage.points) p = {p.x, -p.z, p.y};
  surfaces::PatchSet set = approximated(std::move(cage), settings);
  const Mesh shape = patchMesh(set, settings.tessellation);
  Bounds bounds;
  for (const glm::dvec3& p : shape.positions) bounds.extend(p);
  const double scale = 1.0 / (bounds.high.y - bounds.low.y);
  glm::dmat4 place(scale);
  place[3] = {0.0, 0.01 - scale * bounds.low.y, 0.0, 1.0};
  Scene scene;
  const double reach = scale * bounds.high.x;
  addGround(scene, 8.0 * reach);
  addSurface(scene, "double_torus", transformed(std::move(set), place), settings.tessellation,
             {0.7F, 0.62F, 0.55F});
  frameStanding(scene, 1.0, reach);
  return scene;
}

const RegisteredScene<SubdivisionSettings> kSubdivision{
    {.name = "curved/subdivision",
     .version = 1,
     .summary = "Two joined rings as a subdivision surface of 48 quads, by patches that approximate it",
     .source = "Schwarz 2009, section 6.1.5"},
    buildSubdivision};

}  // namespace
}  // namespace limen::scene
