// SPDX-License-Identifier: BSD-3-Clause
// Control meshes of subdivision surfaces, beside the patches that stand in for them (Holländer 2013, chapter
// 2).
#include "renderer/scene/curved/figure.h"
#include "renderer/scene/curved/patch_mesh.h"
#include "renderer/scene/curved/subdivision_cages.h"
#include "renderer/scene/stage.h"
#include "renderer/surfaces/acc_patches.h"
#include "renderer/surfaces/pn_set.h"
#include "renderer/surfaces/qas_patches.h"

namespace limen::scene {
namespace {

enum class Substitute { Flat, Phong, Pn, Qas };
constexpr EnumNames<Substitute, 4> enumNames(Substitute) {
  return {{{{Substitute::Flat, "flat"},
            {Substitute::Phong, "phong"},
            {Substitute::Pn, "pn"},
            {Substitute::Qas, "qas"}}}};
}

enum class CageScheme { Loop, CatmullClark, Butterfly };
constexpr EnumNames<CageScheme, 3> enumNames(CageScheme) {
  return {{{{CageScheme::Loop, "loop"},
            {CageScheme::CatmullClark, "catmull_clark"},
            {CageScheme::Butterfly, "butterfly"}}}};
}

struct FigureSettings {
  CageScheme scheme = CageScheme::Loop;
  Substitute substitute = Substitute::Pn;
  int tessellation = 1;
  static const SettingsTable<FigureSettings>& table() {
    using S = FigureSettings;
    static const SettingsTable<S> kTable = {
        {&S::scheme, "scheme", "Rules of subdivision", "Holländer 2013, section 2.1.1"},
        {&S::substitute, "substitute",
         "What stands in for the surface where a technique takes patches: the cage's triangles, flat, with "
         "Phong "
         "tessellation or as PN triangles, or quadratic triangles of one step of subdivision",
         "Holländer 2013, section 2.1.3"},
        {&S::tessellation,
         "tessellation",
         {1, 32},
         "segments",
         "Segments along each side of a patch in the mesh"}};
    return kTable;
  }
};

surfaces::PatchSet substituteFor(const surfaces::PolygonMesh& cage, Substitute substitute) {
  const surfaces::PolygonMesh triangles = surfaces::triangulated(cage);
  if (substitute == Substitute::Qas) return surfaces::qasPatches(triangles);
  surfaces::BaseMesh base;
  base.positions = triangles.points;
  std::vector<glm::dvec3> normals(base.positions.size(), glm::dvec3(0.0));
  for (const std::vector<uint32_t>& f : triangles.faces) {
    base.triangles.emplace_back(f[0], f[1], f[2]);
    const glm::dvec3 &a = base.positions[f[0]], &b = base.positions[f[1]], &c = base.positions[f[2]];
    for (const uint32_t v : f) normals[v] += glm::cross(b - a, c - a);
  }
  const auto unit = [](glm::dvec3 n) {
    return glm::dot(n, n) > 0.0 ? glm::normalize(n) : glm::dvec3(0.0, 0.0, 1.0);
  };
  for (const std::vector<uint32_t>& f : triangles.faces)
    base.cornerNormals.push_back({unit(normals[f[0]]), unit(normals[f[1]]), unit(normals[f[2]])});
  if (substitute == Substitute::Pn) return surfaces::pnSet(base);
  return surfaces::phongSet(base, substitute == Substitute::Flat ? 0.0 : 0.75);
}

Scene staged(surfaces::SubdivisionSurface surface, const FigureSettings& settings) {
  Scene scene;
  double reach = 0.0;
  for (const glm::dvec3& p : surface.cage.points) reach = std::max(reach, std::hypot(p.x, p.z));
  addGround(scene, 8.0 * std::max(reach, 1.0));
  surface.part = static_cast<uint32_t>(scene.parts.size());
  addSurface(scene, "figure", substituteFor(surface.cage, settings.substitute), settings.tessellation,
             {0.7F, 0.62F, 0.55F});
  scene.subdivisions.push_back(std::move(surface));
  frameStanding(scene, 1.0, reach);
  return scene;
}

Scene buildFigure(const FigureSettings& settings) {
  surfaces::SubdivisionSurface surface =
      settings.scheme == CageScheme::CatmullClark ? figureOfQuads() : figureOfTriangles();
  if (settings.scheme == CageScheme::Butterfly) surface.scheme = surfaces::SubdivisionScheme::Butterfly;
  return staged(std::move(surface), settings);
}

const RegisteredScene<FigureSettings> kFigure{
    {.name = "curved/figure",
     .version = 1,
     .summary = "A jointed figure as the control mesh of a subdivision surface: 1,450 vertices",
     .source = "Holländer 2013, Table 2.1 (in place of its Big Guy)"},
    buildFigure};

enum class ControlCage { Octahedron, Tetrahedron, Sheet, Fan, Valence, Crease, Collapsed, TwoTorus, Seamed };
constexpr EnumNames<ControlCage, 9> enumNames(ControlCage) {
  return {{{{ControlCage::Octahedron, "octahedron"},
            {ControlCage::Tetrahedron, "tetrahedron"},
            {ControlCage::Sheet, "sheet"},
            {ControlCage::Fan, "fan"},
            {ControlCage::Valence, "valence"},
            {ControlCage::Crease, "crease"},
            {ControlCage::Collapsed, "collapsed"},
            {ControlCage::TwoTorus, "double_torus"},
            {ControlCage::Seamed, "seamed_ring"}}}};
}

struct ControlMeshSettings {
  ControlCage cage = ControlCage::Fan;
  int valence = 24;
  double sharpness = surfaces::kInfinitelySharp;
  FigureSettings figure;
  static const SettingsTable<ControlMeshSettings>& table() {
    using S = ControlMeshSettings;
    static const SettingsTable<S> kTable = {
        {&S::cage, "cage",
         "Control mesh: closed ones of valence 4 or 3, an open sheet, open triangles around a vertex, two "
         "pyramids "
         "base to base, those with a sharp waist, those with a collapsed triangle, two joined rings, or a "
         "ring with texture coordinates that end at seams"},
        {&S::valence,
         "valence",
         {3, 50},
         "edges",
         "Of the vertices that fan, valence, crease and collapsed have"},
        {&S::sharpness,
         "sharpness",
         {0.0, surfaces::kInfinitelySharp},
         "steps",
         "For how many steps the edges of crease stay sharp; 10: for ever",
         "DeRose et al. 1998"},
        included(&S::figure)};
    return kTable;
  }
};

surfaces::PolygonMesh cageOf(const ControlMeshSettings& settings) {
  const auto n = static_cast<uint32_t>(settings.valence);
  switch (settings.cage) {
    case ControlCage::Octahedron:
      return pyramids(4);
    case ControlCage::Tetrahedron:
      return tetrahedron();
    case ControlCage::Sheet:
      return bumpySheet(6, settings.figure.scheme == CageScheme::CatmullClark);
    case ControlCage::Fan:
      return openFan(n);
    case ControlCage::Crease: {
      surfaces::PolygonMesh mesh = pyramids(n);
      for (uint32_t i = 0; i < n; ++i)
        mesh.sharpness[surfaces::edgeKey(2 + i, 2 + (i + 1) % n)] = settings.sharpness;
      return mesh;
    }
    case ControlCage::Collapsed: {
      surfaces::PolygonMesh mesh = pyramids(n);
      mesh.points[3] = mesh.points[2];
      return mesh;
    }
    case ControlCage::TwoTorus: {
      surfaces::PolygonMesh mesh = closedCage(CageShape::DoubleTorus);
      return settings.figure.scheme == CageScheme::CatmullClark ? mesh
                                                                : surfaces::triangulated(std::move(mesh));
    }
    default:
      return pyramids(n);
  }
}

Scene buildControlMesh(const ControlMeshSettings& settings) {
  surfaces::SubdivisionSurface surface;
  if (settings.cage == ControlCage::Seamed)
    surface = seamedRing(settings.figure.scheme == CageScheme::CatmullClark);
  else
    surface.cage = cageOf(settings);
  surface.scheme = settings.figure.scheme == CageScheme::CatmullClark
                       ? surfaces::SubdivisionScheme::CatmullClark
                   : settings.figure.scheme == CageScheme::Butterfly ? surfaces::SubdivisionScheme::Butterfly
                                                                     : surfaces::SubdivisionScheme::Loop;
  Bounds bounds;
  for (const glm::dvec3& p : surface.cage.points) bounds.extend(p);
  const double scale = 1.0 / (bounds.high.y - bounds.low.y);
  for (glm::dvec3& p : surface.cage.points) p = scale * (p - glm::dvec3(0.0, bounds.low.y, 0.0));
  return staged(std::move(surface), settings.figure);
}

const RegisteredScene<ControlMeshSettings> kControlMeshScene{
    {.name = "curved/control_mesh",
     .version = 1,
     .summary =
         "Control meshes that subdivision may trip over: extreme valences, boundaries, creases, collapsed "
         "triangles",
     .source = "bench"},
    buildControlMesh};

}  // namespace
}  // namespace limen::scene
