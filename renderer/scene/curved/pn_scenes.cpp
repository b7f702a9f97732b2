// SPDX-License-Identifier: BSD-3-Clause
// Meshes whose triangles become curved by their normals (Schwarz 2009, sections 6.1.3 and 7.6.3).
#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "experiments/base/error.h"
#include "renderer/scene/curved/double_torus.h"
#include "renderer/scene/curved/patch_mesh.h"
#include "renderer/scene/curved/pn_parameters.h"
#include "renderer/scene/import.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

using surfaces::BaseMesh;

const char* const kSegments = "Segments along each side of a patch in the mesh";
constexpr glm::vec3 kClay{0.7F, 0.62F, 0.55F};

void scaleAndMove(BaseMesh& mesh, double scale, glm::dvec3 by) {
  for (glm::dvec3& position : mesh.positions) position = scale * position + by;
}

Bounds boundsOf(const BaseMesh& mesh) {
  Bounds bounds;
  for (const glm::dvec3& position : mesh.positions) bounds.extend(position);
  return bounds;
}

struct DoubleTorusSettings {
  CurvedForm form;
  int tessellation = 8;
  static const SettingsTable<DoubleTorusSettings>& table() {
    using S = DoubleTorusSettings;
    static const SettingsTable<S> kTable = {
        formBinding(&S::form), {&S::tessellation, "tessellation", {1, 32}, "segments", kSegments}};
    return kTable;
  }
};

/// Stands upright, 1 high, with its holes towards the camera.
Scene buildDoubleTorus(const DoubleTorusSettings& settings) {
  BaseMesh mesh = doubleTorus();
  for (glm::dvec3& p : mesh.positions) p = {p.x, -p.z, p.y};
  for (auto& normals : mesh.cornerNormals)
    for (glm::dvec3& n : normals) n = {n.x, -n.z, n.y};
  const Bounds bounds = boundsOf(mesh);
  const double scale = 1.0 / (bounds.high.y - bounds.low.y);
  scaleAndMove(mesh, scale, {0.0, 0.01 - scale * bounds.low.y, 0.0});
  Scene scene;
  const double reach = scale * bounds.high.x;
  addGround(scene, 8.0 * reach);
  addSurface(scene, "double_torus", curvedSet(mesh, settings.form), settings.tessellation, kClay);
  frameStanding(scene, 1.0, reach);
  return scene;
}

enum class StarView { Overview, CloseUp };
constexpr EnumNames<StarView, 2> enumNames(StarView) {
  return {{{{StarView::Overview, "overview"}, {StarView::CloseUp, "close_up"}}}};
}

struct StarFieldSettings {
  CurvedForm form;
  StarView view = StarView::Overview;
  int layers = 13, tessellation = 4;
  int64_t seed = 1;
  static const SettingsTable<StarFieldSettings>& table() {
    using S = StarFieldSettings;
    static const SettingsTable<S> kTable = {
        formBinding(&S::form),
        {&S::view, "view", "All stars, or a few of them that fill the picture"},
        {&S::layers,
         "layers",
         {1, 13},
         "",
         "Layers of 19 x 7 stars, one behind the other",
         "Schwarz 2009, Table 7.6 (41,496 triangles: 13)"},
        {&S::tessellation, "tessellation", {1, 8}, "segments", kSegments},
        {&S::seed, "seed", {0, 1000000}, "", "Seed of places and rotations"}};
    return kTable;
  }
};

/// Two tetrahedra through each other: a tip on each face of an octahedron, 24 triangles. Tips lie at distance
/// 1 from the origin.
BaseMesh star() {
  const Mesh octahedron = sphere(glm::dvec3(0.0), std::sqrt(1.0 / 3.0), 1);
  BaseMesh mesh;
  mesh.positions = octahedron.positions;
  for (const glm::uvec3& t : octahedron.triangles) {
    const auto tip = static_cast<uint32_t>(mesh.positions.size());
    const glm::dvec3 out = octahedron.positions[t.x] + octahedron.positions[t.y] + octahedron.positions[t.z];
    mesh.positions.push_back(glm::normalize(out));
    mesh.triangles.insert(mesh.triangles.end(), {{t.x, t.y, tip}, {t.y, t.z, tip}, {t.z, t.x, tip}});
  }
  mergePositions(mesh);
  computeCornerNormals(mesh, 180.0);
  return mesh;
}

/// Layers of 19 x 7 stars, each turned and moved at random within its cell.
Scene buildStarField(const StarFieldSettings& settings) {
  const glm::ivec3 stars(19, 7, settings.layers);
  const BaseMesh one = star();
  Random random(settings.seed);
  BaseMesh field;
  constexpr double kCell = 0.25, kRadius = 0.085;
  for (int z = 0; z < stars.z; ++z)
    for (int y = 0; y < stars.y; ++y)
      for (int x = 0; x < stars.x; ++x) {
        const glm::dvec3 axis = random.direction();
        const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), random.uniform(0.0, 2.0 * M_PI), axis));
        const glm::dvec3 shift = random.direction() * random.uniform(0.0, 0.5 * kCell - kRadius);
        const glm::dvec3 cell((x - 0.5 * (stars.x - 1)) * kCell, 0.3 + (y + 0.5) * kCell,
                              (z - 0.5 * (stars.z - 1)) * kCell);
        const auto first = static_cast<uint32_t>(field.positions.size());
        for (const glm::dvec3& p : one.positions)
          field.positions.push_back(cell + shift + kRadius * (turn * p));
        for (size_t t = 0; t < one.triangles.size(); ++t) {
          field.triangles.push_back(one.triangles[t] + first);
          const auto& n = one.cornerNormals[t];
          field.cornerNormals.push_back({turn * n[0], turn * n[1], turn * n[2]});
        }
      }
  Scene scene;
  addGround(scene, 21.0);
  addSurface(scene, "stars", curvedSet(field, settings.form), settings.tessellation, {0.75F, 0.68F, 0.4F});
  const double height = 0.3 + stars.y * kCell;
  frameStanding(scene, height, 0.5 * stars.x * kCell);
  const glm::dvec3 middle(0.0, 0.55 * height, 0.0), corner(0.3, 0.7 * height, 0.5 * stars.z * kCell);
  setStillCamera(scene, settings.view == StarView::Overview ? orbitCamera(middle, 8.0, 20.0, 40.0)
                                                            : orbitCamera(corner, 1.0, 20.0, 15.0, 45.0));
  return scene;
}

enum class PnModel { Bunny, Horse, Cat };
constexpr EnumNames<PnModel, 3> enumNames(PnModel) {
  return {{{{PnModel::Bunny, "bunny"}, {PnModel::Horse, "horse"}, {PnModel::Cat, "cat"}}}};
}

struct BaseSettings {
  int triangles = 2000;
  CreasedForm form;
  int tessellation = 4;
  static const SettingsTable<BaseSettings>& table() {
    using S = BaseSettings;
    static const SettingsTable<S> kTable = {
        {&S::triangles,
         "base_triangles",
         {100, 100000},
         "",
         "Most triangles of the base mesh, to which larger ones are simplified",
         "Schwarz 2009, Table 7.1 (bunny: 2,000)"},
        formBinding(&S::form),
        {&S::tessellation, "tessellation", {1, 16}, "segments", kSegments}};
    return kTable;
  }
};

struct PnModelSettings {
  PnModel model = PnModel::Bunny;
  BaseSettings base;
  static const SettingsTable<PnModelSettings>& table() {
    using S = PnModelSettings;
    static const SettingsTable<S> kTable = {{&S::model, "model", "Mesh (package glmark2-data)"},
                                            included(&S::base)};
    return kTable;
  }
};

struct PnMeshSettings {
  FilePath file;
  BaseSettings base;
  static const SettingsTable<PnMeshSettings>& table() {
    using S = PnMeshSettings;
    static const SettingsTable<S> kTable = {
        {&S::file, "file", FileIs::Required, "OBJ, PLY, glTF or 3DS file, y up"}, included(&S::base)};
    return kTable;
  }
};

/// By edge collapse to at most so many triangles, if it gets that far.
void simplify(BaseMesh& mesh, size_t triangles) {
  if (mesh.triangles.size() <= triangles) return;
  const glm::dvec3 middle = boundsOf(mesh).centre();
  std::vector<glm::vec3> positions;
  for (const glm::dvec3& p : mesh.positions) positions.emplace_back(p - middle);
  std::vector<unsigned> indices;
  for (const glm::uvec3& t : mesh.triangles) indices.insert(indices.end(), {t.x, t.y, t.z});
  std::vector<unsigned> kept(indices.size());
  kept.resize(meshopt_simplify(kept.data(), indices.data(), indices.size(), &positions[0].x, positions.size(),
                               sizeof(glm::vec3), 3 * triangles, 1.0F, 0, nullptr));
  mesh.triangles.clear();
  for (size_t i = 0; i < kept.size(); i += 3) mesh.triangles.emplace_back(kept[i], kept[i + 1], kept[i + 2]);
}

Scene curvedMesh(ImportedMesh file, const BaseSettings& settings) {
  standOnGround(file.mesh, 1.0);
  BaseMesh mesh{file.mesh.positions, file.mesh.triangles, {}};
  mergePositions(mesh);
  simplify(mesh, static_cast<size_t>(settings.triangles));
  if (mesh.triangles.empty()) throw Error("the mesh has no triangle with an area");
  const Bounds bounds = boundsOf(mesh);
  const double reach = std::max({bounds.high.x, -bounds.low.x, bounds.high.z, -bounds.low.z});
  // Curved triangles bulge; the base mesh touches the ground.
  scaleAndMove(mesh, 1.0, {0.0, 0.02, 0.0});
  Scene scene;
  addGround(scene, 8.0 * std::max(1.25, reach));
  addSurface(scene, "mesh", curvedSet(mesh, settings.form), settings.tessellation, kClay);
  // Wider than high, for the horse's neck and tail.
  frameStanding(scene, 1.0, std::max(reach, 1.25));
  return scene;
}

Scene buildPnModel(const PnModelSettings& settings) {
  const char* const file = settings.model == PnModel::Bunny   ? "bunny.obj"
                           : settings.model == PnModel::Horse ? "horse.3ds"
                                                              : "cat.3ds";
  ImportedMesh mesh = importMesh(installedModel(file));
  // As in the scene "cat": the file was saved with y up, and 3DS is read as z up.
  if (settings.model == PnModel::Cat)
    for (glm::dvec3& p : mesh.mesh.positions) p = {p.x, -p.z, p.y};
  return curvedMesh(std::move(mesh), settings.base);
}

Scene buildPnMesh(const PnMeshSettings& settings) {
  return curvedMesh(importMesh(settings.file.path), settings.base);
}

const RegisteredScene<DoubleTorusSettings> kDoubleTorus{
    {.name = "curved/double_torus",
     .version = 1,
     .summary = "Two joined rings of 1,536 base triangles as PN triangles or Phong tessellation",
     .source = "stand-in with the same count for Schwarz 2009, Table 7.1"},
    buildDoubleTorus};

const RegisteredScene<StarFieldSettings> kStarField{
    {.name = "curved/star_field",
     .version = 1,
     .summary = "1,729 stars of 24 base triangles each as PN triangles or Phong tessellation",
     .source = "stand-in with the same count for Schwarz 2009, Table 7.6"},
    buildStarField};

const RegisteredScene<PnModelSettings> kPnModel{
    {.name = "curved/pn_model",
     .version = 1,
     .summary =
         "Bunny, horse or cat of height 1 as PN triangles or Phong tessellation over few base triangles",
     .source = "Schwarz 2009, section 6.1.3 and Table 7.1"},
    buildPnModel};

const RegisteredScene<PnMeshSettings> kPnMesh{
    {.name = "curved/pn_mesh",
     .version = 1,
     .summary = "Like curved/pn_model with a mesh from a file, scaled to height 1",
     .source = "Schwarz 2009, section 6.1.3 and Table 7.1"},
    buildPnMesh};

}  // namespace
}  // namespace limen::scene
