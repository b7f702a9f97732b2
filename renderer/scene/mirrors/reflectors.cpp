// SPDX-License-Identifier: BSD-3-Clause
// One reflector of a chosen shape among objects (Roger 2008, sections 2.4 and 3.4): an ellipsoid, an
// irregular sheet, a bunny in several resolutions, a concave bowl.
#include <cmath>

#include "renderer/scene/import.h"
#include "renderer/scene/lod/mesh_chain.h"
#include "renderer/scene/mirrors/mirror_parts.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

constexpr Range kReflectanceRange{0.0, 1.0};
constexpr const char* kReflectanceText = "Share of the light that the mirror reflects";

struct MirrorEllipsoidSettings {
  double width = 1.0, height = 1.5, depth = 0.7;
  int tessellation = 48;
  double reflectance = 0.8;
  ObjectMotion motion;
  static const SettingsTable<MirrorEllipsoidSettings>& table() {
    using S = MirrorEllipsoidSettings;
    static const SettingsTable<S> kTable = {
        {&S::width, "width", {0.1, 4.0}, "world units", "Semi-axis along x"},
        {&S::height, "height", {0.1, 4.0}, "world units", "Vertical semi-axis"},
        {&S::depth, "depth", {0.1, 4.0}, "world units", "Semi-axis along z"},
        {&S::tessellation, "tessellation", {1, 128}, "segments", "Segments in a quarter of its sections"},
        {&S::reflectance, "reflectance", kReflectanceRange, "", kReflectanceText},
        {&S::motion, "motion", kMotionText}};
    return kTable;
  }
};

/// Objects around a reflector that is `reach` wide and stands on the ground.
void addCompany(Scene& scene, double reach, const ObjectMotion& motion) {
  const auto at = [&](double x, double z) { return glm::dvec3(x * reach, 0.0, z * reach); };
  addPart(scene, "red box", box(at(1.3, -0.2), at(1.8, 0.3) + glm::dvec3(0.0, 0.8 * reach, 0.0)),
          {0.7F, 0.25F, 0.2F});
  moveLastPart(scene, motion, {.pivot = at(1.55, 0.05), .turnDegS = 90.0});
  addPart(scene, "blue box", box(at(-2.0, 0.4), at(-1.5, 0.9) + glm::dvec3(0.0, 0.6 * reach, 0.0)),
          {0.25F, 0.5F, 0.7F});
  moveLastPart(scene, motion, {.pivot = at(-1.75, 0.65), .travel = at(0.0, 0.6), .periodS = 2.0});
  addPart(scene, "cone",
          frustum(at(0.3, 1.8), at(0.3, 1.8) + glm::dvec3(0.0, 0.7 * reach, 0.0), 0.3 * reach, 0.0, 48),
          {0.3F, 0.6F, 0.3F});
  moveLastPart(scene, motion, {.turnDegS = 30.0});  // around the reflector
}

Scene buildMirrorEllipsoid(const MirrorEllipsoidSettings& settings) {
  Scene scene;
  const glm::dvec3 semiAxes(settings.width, settings.height, settings.depth);
  const double reach = std::max(settings.width, settings.depth);
  addCheckeredGround(scene, 12.0 * reach, 0.5 * reach);
  addPart(scene, ellipsoid({0.0, settings.height, 0.0}, semiAxes, settings.tessellation),
          mirrorMaterial(settings.reflectance));
  addCompany(scene, reach, settings.motion);
  frameStanding(scene, 2.0 * settings.height, 1.5 * reach);
  return scene;
}

const RegisteredScene<MirrorEllipsoidSettings> kMirrorEllipsoid{
    {.name = "mirrors/ellipsoid",
     .version = 1,
     .summary = "Mirroring ellipsoid of any axes among objects on a checkered floor",
     .source = "after Roger 2008, section 2.4 (shape of its numerical checks: 1 x 1.5 x 0.7)"},
    buildMirrorEllipsoid};

struct MirrorSheetSettings {
  double irregularity = 3.0, amplitude = 0.1;
  int tessellation = 96;
  double reflectance = 0.8;
  static const SettingsTable<MirrorSheetSettings>& table() {
    using S = MirrorSheetSettings;
    static const SettingsTable<S> kTable = {
        {&S::irregularity,
         "irregularity",
         {0.0, 64.0},
         "1/world unit",
         "n of the height a cos(n x) cos(n z)",
         "Roger 2008, section 3.4"},
        {&S::amplitude,
         "amplitude",
         {0.0, 1.0},
         "world units",
         "a of the height a cos(n x) cos(n z)",
         "Roger 2008, section 3.4 (1 there)"},
        {&S::tessellation, "tessellation", {1, 512}, "segments", "Squares along a side"},
        {&S::reflectance, "reflectance", kReflectanceRange, "", kReflectanceText}};
    return kTable;
  }
};

Scene buildMirrorSheet(const MirrorSheetSettings& settings) {
  Scene scene;
  const double n = settings.irregularity, a = settings.amplitude;
  const Mesh sheet = heightSheet(
      {0.0, 0.1 + a, 0.0}, 3.0, settings.tessellation,
      [&](double x, double z) { return a * std::cos(n * x) * std::cos(n * z); },
      [&](double x, double z) {
        return glm::dvec2(-a * n * std::sin(n * x) * std::cos(n * z),
                          -a * n * std::cos(n * x) * std::sin(n * z));
      });
  addCheckeredGround(scene, 8.0, 0.5);
  addPart(scene, sheet, mirrorMaterial(settings.reflectance));
  const double top = 0.1 + 2.0 * a;
  addPart(scene, "ball", sphere({-0.6, top + 0.5, -0.3}, 0.35, 24), {0.7F, 0.25F, 0.2F});
  addPart(scene, "box", box({0.3, top + 0.1, -0.6}, {0.9, top + 0.7, -0.2}), {0.25F, 0.5F, 0.7F});
  frameStanding(scene, 1.5, 1.8);
  return scene;
}

const RegisteredScene<MirrorSheetSettings> kMirrorSheet{
    {.name = "mirrors/sheet",
     .version = 1,
     .summary = "Mirroring sheet a cos(n x) cos(n z), of any irregularity, below a ball and a box",
     .source = "Roger 2008, section 3.4 (irregularity of reflectors)"},
    buildMirrorSheet};

enum class BunnyRole { Reflector, Reflected };
constexpr EnumNames<BunnyRole, 2> enumNames(BunnyRole) {
  return {{{{BunnyRole::Reflector, "reflector"}, {BunnyRole::Reflected, "reflected"}}}};
}

struct MirrorBunnySettings {
  BunnyRole role = BunnyRole::Reflected;
  double share = 1.0, reflectance = 0.8, glossRad = 0.0;
  ObjectMotion motion;
  static const SettingsTable<MirrorBunnySettings>& table() {
    using S = MirrorBunnySettings;
    static const SettingsTable<S> kTable = {
        {&S::role, "bunny", "Whether the bunny reflects a box, or a ball reflects the bunny"},
        {&S::share,
         "detail",
         {0.005, 1.0},
         "",
         "Share of the bunny's triangles (69,451) that is kept",
         "Roger 2008, Figs. 3.16 and 5.13 (948 to 71 K triangles)"},
        {&S::reflectance, "reflectance", kReflectanceRange, "", kReflectanceText},
        {&S::glossRad,
         "gloss",
         {0.0, 1.0},
         "rad",
         "Half-angle of the cone from which the mirror gathers light",
         "Roger 2008, Fig. 5.10"},
        {&S::motion, "motion", kMotionText}};
    return kTable;
  }
};

Mesh bunnyOf(double share) {
  ImportedMesh imported = importMesh(installedModel("bunny.obj"));
  standOnGround(imported.mesh, 1.0);
  if (share >= 1.0) {
    imported.mesh.normals = vertexNormals(imported.mesh);
    return imported.mesh;
  }
  Mesh mesh = simplifiedChain("bunny", imported.mesh, {share}).levels.back().mesh;
  mesh.morphTargets.clear();
  mesh.normals = vertexNormals(mesh);
  return mesh;
}

Scene buildMirrorBunny(const MirrorBunnySettings& settings) {
  Scene scene;
  addCheckeredGround(scene, 8.0, 0.25);
  const Material mirror = mirrorMaterial(settings.reflectance, settings.glossRad);
  if (settings.role == BunnyRole::Reflector) {
    addPart(scene, bunnyOf(settings.share), mirror);
    addCompany(scene, 0.8, settings.motion);
  } else {
    Material fur;
    fur.name = "bunny";
    fur.albedo = glm::vec3(0.7F, 0.5F, 0.35F);
    addPart(scene, movedMesh(bunnyOf(settings.share), 0.8, -25.0, {0.75, 0.0, 0.9}), fur);
    moveLastPart(scene, settings.motion,
                 {.pivot = {0.75, 0.0, 0.9}, .turnDegS = 60.0, .travel = {0.12, 0.0, 0.12}, .periodS = 2.0});
    addPart(scene, ellipsoid({-0.2, 0.5, 0.0}, glm::dvec3(0.5), 48), mirror);
  }
  frameStanding(scene, 1.0, 1.0);
  return scene;
}

const RegisteredScene<MirrorBunnySettings> kMirroredBunny{
    {.name = "mirrors/bunny",
     .version = 1,
     .summary = "Bunny in any resolution that reflects, or that a ball reflects, on a checkered floor",
     .source = "Roger 2008, Figs. 3.16, 5.10 and 5.13 (package glmark2-data)"},
    buildMirrorBunny};

struct MirrorBowlSettings {
  int tessellation = 64;
  double depthDeg = 70.0, reflectance = 0.8;
  static const SettingsTable<MirrorBowlSettings>& table() {
    using S = MirrorBowlSettings;
    static const SettingsTable<S> kTable = {
        {&S::tessellation,
         "tessellation",
         {3, 256},
         "segments",
         "Segments of its circles and of its section"},
        {&S::depthDeg,
         "depth",
         {10.0, 85.0},
         "deg",
         "Angle between the bowl's axis and its rim, seen from the middle"},
        {&S::reflectance, "reflectance", kReflectanceRange, "", kReflectanceText}};
    return kTable;
  }
};

/// A bowl of radius 1 that opens upwards, seen from above: paraxially it images objects nearer than half the
/// radius upright, those beyond the radius inverted, and those between behind the viewer.
Scene buildMirrorBowl(const MirrorBowlSettings& settings) {
  Scene scene;
  addCheckeredGround(scene, 8.0, 0.5);
  std::vector<glm::dvec2> profile;
  // From the rim inwards: the outside of the profile is the bowl's inside.
  for (int i = settings.tessellation; i >= 0; --i) {
    const double angle = glm::radians(settings.depthDeg) * i / settings.tessellation;
    profile.emplace_back(i == 0 ? 0.0 : std::sin(angle), 1.05 - std::cos(angle));
  }
  Mesh bowl = lathe(glm::dvec3(0.0), profile, settings.tessellation);
  bowl.normals.clear();
  for (const glm::dvec3& position : bowl.positions)
    bowl.normals.emplace_back(glm::normalize(glm::dvec3(0.0, 1.05, 0.0) - position));
  addPart(scene, bowl, mirrorMaterial(settings.reflectance));
  // At a fourth, at three fourths and at twice the radius from the bottom.
  addPart(scene, "near", sphere({0.25, 0.3, 0.0}, 0.07, 16), {0.7F, 0.25F, 0.2F});
  addPart(scene, "between", box({-0.36, 0.73, -0.06}, {-0.24, 0.85, 0.06}), {0.3F, 0.6F, 0.3F});
  addPart(scene, "far", frustum({0.0, 1.95, -0.3}, {0.0, 2.35, -0.3}, 0.2, 0.0, 48), {0.25F, 0.5F, 0.7F});
  scene.lights = {lightTowards({-2.0, 5.0, 2.0}, {0.0, 0.5, 0.0}, glm::dvec2(0.3))};
  setStillCamera(scene, orbitCamera({0.0, 0.6, 0.0}, 4.2, 10.0, 50.0));
  return scene;
}

const RegisteredScene<MirrorBowlSettings> kMirrorBowl{
    {.name = "mirrors/bowl",
     .version = 1,
     .summary = "Concave mirror with objects within half its radius, up to its radius, and beyond",
     .source = "Roger 2008, Fig. 2.16"},
    buildMirrorBowl};

}  // namespace
}  // namespace limen::scene
