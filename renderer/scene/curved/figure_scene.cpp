// SPDX-License-Identifier: BSD-3-Clause
// Control meshes of subdivision surfaces, beside the patches that stand in for them (Holländer 2013, chapter
// 2).
#include <variant>

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

enum class ControlCage { Fan, Octahedron, Tetrahedron, Sheet, Valence, Crease, Collapsed, TwoTorus, Seamed };
struct CageText {
  const char *kind, *summary;
};
constexpr CageText kCages[] = {{"fan", "open triangles around a vertex"},
                               {"octahedron", "two pyramids, base to base, of valence 4"},
                               {"tetrahedron", "closed, of valence 3"},
                               {"sheet", "open"},
                               {"valence", "two pyramids, base to base"},
                               {"crease", "two pyramids with a sharp waist"},
                               {"collapsed", "two pyramids with a collapsed triangle"},
                               {"double_torus", "two joined rings"},
                               {"seamed_ring", "a ring with texture coordinates that end at seams"}};
template <ControlCage kCage>
struct Cage {
  static constexpr const char *kKind = kCages[int(kCage)].kind, *kSummary = kCages[int(kCage)].summary;
  static const SettingsTable<Cage>& table() {
    static const SettingsTable<Cage> kTable = {};
    return kTable;
  }
};
template <>
struct Cage<ControlCage::Crease> {
  static constexpr const char *kKind = "crease", *kSummary = kCages[int(ControlCage::Crease)].summary;
  double sharpness = surfaces::kInfinitelySharp;
  static const SettingsTable<Cage>& table() {
    static const SettingsTable<Cage> kTable = {{&Cage::sharpness,
                                                "sharpness",
                                                {0.0, surfaces::kInfinitelySharp},
                                                "steps",
                                                "For how many steps the waist stays sharp; 10: for ever",
                                                "DeRose et al. 1998"}};
    return kTable;
  }
};
using AnyCage =
    std::variant<Cage<ControlCage::Fan>, Cage<ControlCage::Octahedron>, Cage<ControlCage::Tetrahedron>,
                 Cage<ControlCage::Sheet>, Cage<ControlCage::Valence>, Cage<ControlCage::Crease>,
                 Cage<ControlCage::Collapsed>, Cage<ControlCage::TwoTorus>, Cage<ControlCage::Seamed>>;

struct ControlMeshSettings {
  AnyCage cage;
  int valence = 24;
  FigureSettings figure;
  ControlCage shape() const { return static_cast<ControlCage>(cage.index()); }
  static const SettingsTable<ControlMeshSettings>& table() {
    using S = ControlMeshSettings;
    static const SettingsTable<S> kTable = {{&S::cage, "cage", "Control mesh"},
                                            {&S::valence,
                                             "valence",
                                             {3, 50},
                                             "edges",
                                             "Of the vertices that fan, valence, crease and collapsed have"},
                                            included(&S::figure)};
    return kTable;
  }
};

surfaces::PolygonMesh cageOf(const ControlMeshSettings& settings) {
  const auto n = static_cast<uint32_t>(settings.valence);
  switch (settings.shape()) {
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
        mesh.sharpness[surfaces::edgeKey(2 + i, 2 + (i + 1) % n)] =
            std::get<Cage<ControlCage::Crease>>(settings.cage).sharpness;
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
  if (settings.shape() == ControlCage::Seamed)
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
