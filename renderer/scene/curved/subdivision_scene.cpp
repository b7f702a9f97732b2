// SPDX-License-Identifier: BSD-3-Clause
// Subdivision surfaces by the patches that approximate them (Schwarz 2009, section 6.1.5).
#include "renderer/scene/curved/patch_mesh.h"
#include "renderer/scene/curved/subdivision_cages.h"
#include "renderer/scene/stage.h"
#include "renderer/surfaces/acc_patches.h"
#include "renderer/surfaces/c_patches.h"
#include "renderer/surfaces/catmull_clark.h"
#include "renderer/surfaces/loop_subdivision.h"
#include "renderer/surfaces/patch_builder.h"
#include "renderer/surfaces/pccm_patches.h"
#include "renderer/surfaces/pm_patches.h"
#include "renderer/surfaces/qas_patches.h"

namespace limen::scene {
namespace {

enum class Approximation { Acc, AccTangents, CPatches, Pccm, Pm, Qas };
constexpr EnumNames<Approximation, 6> enumNames(Approximation) {
  return {{{{Approximation::Acc, "acc"},
            {Approximation::AccTangents, "acc_tangents"},
            {Approximation::CPatches, "c_patches"},
            {Approximation::Pccm, "pccm"},
            {Approximation::Pm, "pm_patches"},
            {Approximation::Qas, "qas"}}}};
}

struct SubdivisionSettings {
  CageShape shape = CageShape::DoubleTorus;
  Approximation approximation = Approximation::Acc;
  int steps = 1, tessellation = 8;
  static const SettingsTable<SubdivisionSettings>& table() {
    using S = SubdivisionSettings;
    static const SettingsTable<S> kTable = {
        {&S::shape, "shape",
         "Two joined rings of 48 quads; or a block of 6, smooth, with sharp edges around its top and its "
         "bottom, or with two upright ones as well; or a house of a pentagon, quads and triangles; all but "
         "pccm and pm_patches keep these edges"},
        {&S::approximation, "approximation",
         "Bicubic patches over the quads of Catmull-Clark's surface, shaded with their own normals or "
         "with those of tangent patches (Loop and Schaefer 2008); four quartic triangles for each quad that "
         "join smoothly (Myles, Yeo "
         "and Peters 2008); four bicubic patches that do (Peters 2000; after a step at least); fans of "
         "quartic triangles over faces of three to five sides that do (Myles, Ni and Peters 2008); or "
         "quadratic "
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
  void check() const {
    if (shape == CageShape::House && steps == 0 && approximation != Approximation::Pm)
      throw Error("not all faces are quads", "steps", "a house needs a step or more, but for pm_patches");
    if (shape == CageShape::House && steps < 2 && approximation == Approximation::Pccm)
      throw Error("quads have two extraordinary vertices", "steps", "pccm needs two steps of a house");
    if (approximation == Approximation::Pccm && steps < 1)
      throw Error("quads have two extraordinary vertices", "steps", "pccm needs a step or more");
    const bool sharp = shape == CageShape::CreasedBlock || shape == CageShape::CorneredBlock;
    if (sharp && (approximation == Approximation::Pccm || approximation == Approximation::Pm))
      throw Error("pccm and pm_patches round sharp edges off", "shape", "use acc, acc_tangents or c_patches");
  }
};

surfaces::PatchSet approximated(surfaces::PolygonMesh cage, const SubdivisionSettings& settings) {
  if (settings.approximation == Approximation::Qas)
    return surfaces::qasPatches(surfaces::loop(surfaces::triangulated(std::move(cage)), settings.steps));
  const surfaces::PolygonMesh mesh = surfaces::catmullClark(std::move(cage), settings.steps);
  if (settings.approximation == Approximation::CPatches) return surfaces::cPatches(mesh);
  if (settings.approximation == Approximation::Pccm) return surfaces::pccmPatches(mesh);
  if (settings.approximation == Approximation::Pm) return surfaces::pmPatches(mesh);
  return surfaces::accPatches(mesh, settings.approximation == Approximation::AccTangents
                                        ? surfaces::AccNormals::TangentPatches
                                        : surfaces::AccNormals::Geometry);
}

/// Stands upright, 1 high, as curved/double_torus.
Scene buildSubdivision(const SubdivisionSettings& settings) {
  surfaces::PatchSet set = approximated(closedCage(settings.shape), settings);
  const Mesh shape = patchMesh(set, settings.tessellation);
  Bounds bounds;
  for (const glm::dvec3& p : shape.positions) bounds.extend(p);
  const double scale = 1.0 / (bounds.high.y - bounds.low.y);
  glm::dmat4 place(scale);
  place[3] = {0.0, 0.01 - scale * bounds.low.y, 0.0, 1.0};
  Scene scene;
  const double reach = scale * bounds.high.x;
  addGround(scene, 8.0 * reach);
  addSurface(scene, settings.shape == CageShape::DoubleTorus ? "double_torus" : "block",
             transformed(std::move(set), place), settings.tessellation, {0.7F, 0.62F, 0.55F});
  frameStanding(scene, 1.0, reach);
  return scene;
}

const RegisteredScene<SubdivisionSettings> kSubdivision{
    {.name = "curved/subdivision",
     .version = 1,
     .summary = "Two joined rings, or a block, as a subdivision surface, by patches that approximate it",
     .source = "Schwarz 2009, section 6.1.5"},
    buildSubdivision};

}  // namespace
}  // namespace limen::scene
