// SPDX-License-Identifier: BSD-3-Clause
// Mirrors in large scenes (Roger 2008, section 3.5): a herd on a mirroring ground, and mirrors placed in any
// mesh.
#include <algorithm>
#include <cmath>

#include "renderer/scene/import.h"
#include "renderer/scene/mirrors/mirror_parts.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

struct MirrorHerdSettings {
  int figures = 1000, tessellation = 4;
  double reflectance = 0.5;
  int64_t seed = 1;
  ObjectMotion motion;
  static const SettingsTable<MirrorHerdSettings>& table() {
    using S = MirrorHerdSettings;
    static const SettingsTable<S> kTable = {
        {&S::figures, "figures", {1, 4000}, "", "Figures that stand about"},
        {&S::tessellation,
         "tessellation",
         {1, 24},
         "segments",
         "Segments in a quarter circle of each of nine limbs; 4: 1152 triangles a figure",
         "Roger 2008, section 3.5 (a million triangles)"},
        {&S::reflectance, "reflectance", {0.0, 1.0}, "", "Share of the light that the ground reflects"},
        {&S::seed, "seed", {0, 1000000}, "", "Seed of places and sizes"},
        {&S::motion, "motion", kMotionText}};
    return kTable;
  }
};

/// Parts that move; figures that follow one another in the list share one and move alike.
constexpr int kMovingGroups = 32;

Scene buildMirrorHerd(const MirrorHerdSettings& settings) {
  Scene scene;
  const int aside = static_cast<int>(std::ceil(std::sqrt(double(settings.figures))));
  const double extent = 0.8 * aside;
  Material ground = mirrorMaterial(settings.reflectance);
  ground.name = "ground";
  ground.albedo = glm::vec3(0.25F, 0.3F, 0.3F);
  ground.fresnel = true;
  addPart(scene, planeGrid(glm::dvec3(0.0), 1.4 * extent + 4.0, 1.4 * extent + 4.0, 1), ground,
          Role::ReceiverOnly);
  const Mesh figure = statue(settings.tessellation);
  Random random(settings.seed);
  std::vector<Mesh> herd;
  std::vector<glm::dvec3> places;
  const bool moves = std::holds_alternative<ObjectsInMotion>(settings.motion);
  const int inPart = moves ? (settings.figures + kMovingGroups - 1) / kMovingGroups : settings.figures;
  for (int i = 0; i < settings.figures; ++i) {
    const double x = (i % aside + random.uniform(0.1, 0.9)) * 0.8 - 0.5 * extent,
                 z = (i / aside + random.uniform(0.1, 0.9)) * 0.8 - 0.5 * extent;
    if (i % inPart == 0) {
      herd.emplace_back();
      places.emplace_back(x, 0.0, z);
    }
    append(herd.back(), movedMesh(figure, random.uniform(0.7, 1.2), random.uniform(0.0, 360.0), {x, 0.0, z}));
  }
  Material skin;
  skin.name = "herd";
  skin.albedo = glm::vec3(0.6F, 0.42F, 0.3F);
  if (!moves) {
    // A pattern is one of space, through which nothing may move.
    skin.pattern.kind = Pattern::Kind::ValueNoise;
    skin.pattern.size = 0.2;
  }
  for (size_t i = 0; i < herd.size(); ++i) {
    addPart(scene, herd[i], skin);
    // Each at a pace and in a direction of its own; a figure alone turns as well, several would sweep across
    // others.
    const double angle = 2.4 * double(i);
    moveLastPart(scene, settings.motion,
                 {.pivot = places[i],
                  .turnDegS = inPart == 1 ? (i % 2 == 0 ? 40.0 : -40.0) : 0.0,
                  .travel = 0.3 * glm::dvec3(std::cos(angle), 0.0, std::sin(angle)),
                  .periodS = 2.0 + 0.5 * double(i % 4)});
  }
  scene.lights = {lightTowards({-0.8 * extent, 1.4 * extent + 4.0, 0.9 * extent}, glm::dvec3(0.0),
                               glm::dvec2(0.1 * extent))};
  setStillCamera(scene,
                 {{0.0, 1.2 + 0.12 * extent, 0.55 * extent + 3.0}, {0.0, 0.3, 0.0}, {0.0, 1.0, 0.0}, 40.0});
  return scene;
}

const RegisteredScene<MirrorHerdSettings> kMirrorHerd{
    {.name = "mirrors/herd",
     .version = 1,
     .summary =
         "A thousand figures, over a million triangles, on a mirroring ground; they may walk to and fro",
     .source = "stand-in for Roger 2008, Fig. 3.10 (Alley)"},
    buildMirrorHerd};

struct MirrorBallShape {
  static constexpr const char *kKind = "ball", *kSummary = "a ball";
  int tessellation = 48;
  static const SettingsTable<MirrorBallShape>& table() {
    static const SettingsTable<MirrorBallShape> kTable = {{&MirrorBallShape::tessellation,
                                                           "tessellation",
                                                           {1, 128},
                                                           "segments",
                                                           "Segments in a quarter circle"}};
    return kTable;
  }
};
struct MirrorPaneShape {
  static constexpr const char *kKind = "pane", *kSummary = "an upright square";
  double turnDeg = 0.0;
  static const SettingsTable<MirrorPaneShape>& table() {
    static const SettingsTable<MirrorPaneShape> kTable = {
        {&MirrorPaneShape::turnDeg, "turn", {-180.0, 180.0}, "deg", "About the vertical axis; 0 faces +z"}};
    return kTable;
  }
};

enum class MeshUp { Y, Z };
constexpr EnumNames<MeshUp, 2> enumNames(MeshUp) { return {{{{MeshUp::Y, "y"}, {MeshUp::Z, "z"}}}}; }

struct MirrorMeshSettings {
  FilePath file;
  MeshUp up = MeshUp::Y;
  std::variant<MirrorBallShape, MirrorPaneShape> mirror;
  double x = 0.5, y = 0.5, z = 0.5, size = 0.2, reflectance = 0.8, glossRad = 0.0;
  static const SettingsTable<MirrorMeshSettings>& table() {
    using S = MirrorMeshSettings;
    static const SettingsTable<S> kTable = {
        {&S::file, "file", FileIs::Required, "OBJ, PLY, glTF or 3DS file"},
        {&S::up, "up", "Axis of the file that points up"},
        {&S::mirror, "mirror", "Shape of the mirror that is placed in the mesh"},
        {&S::x, "x", {-1.0, 2.0}, "", "Middle of the mirror, share of the mesh's box along x"},
        {&S::y, "y", {-1.0, 2.0}, "", "Middle of the mirror, share of the mesh's height"},
        {&S::z, "z", {-1.0, 2.0}, "", "Middle of the mirror, share of the mesh's box along z"},
        {&S::size, "size", {1e-3, 2.0}, "", "Diameter or side of the mirror, share of the mesh's height"},
        {&S::reflectance, "reflectance", {0.0, 1.0}, "", "Share of the light that the mirror reflects"},
        {&S::glossRad,
         "gloss",
         {0.0, 1.0},
         "rad",
         "Half-angle of the cone from which the mirror gathers light"}};
    return kTable;
  }
};

Scene buildMirrorMesh(const MirrorMeshSettings& settings) {
  ImportedMesh imported = importMesh(settings.file.path);
  if (settings.up == MeshUp::Z) turnZUpToYUp(imported.mesh);
  standOnGround(imported.mesh, 0.0);
  Bounds bounds;
  for (const glm::dvec3& position : imported.mesh.positions) bounds.extend(position);
  const glm::dvec3 extent = bounds.high - bounds.low;
  // A flat mesh has no height.
  const double height = std::max(extent.y, 0.1 * std::max(extent.x, extent.z));
  const glm::dvec3 middle = bounds.low + glm::dvec3(settings.x, settings.y, settings.z) * extent;
  const double half = 0.5 * settings.size * height;
  Scene scene;
  addImported(scene, imported);
  const Material material = mirrorMaterial(settings.reflectance, settings.glossRad);
  if (const auto* ball = std::get_if<MirrorBallShape>(&settings.mirror)) {
    addPart(scene, ellipsoid(middle, glm::dvec3(half), ball->tessellation), material);
  } else {
    const double turn = glm::radians(std::get<MirrorPaneShape>(settings.mirror).turnDeg);
    addPart(scene, card(middle, half * glm::dvec3(std::cos(turn), 0.0, -std::sin(turn)), {0.0, half, 0.0}),
            material);
  }
  frameStanding(scene, height, 0.5 * std::hypot(extent.x, extent.z));
  return scene;
}

const RegisteredScene<MirrorMeshSettings> kMirrorMesh{
    {.name = "mirrors/mesh",
     .version = 1,
     .summary = "A mesh from a file, in the file's own units, with a mirror placed in it",
     .source = "bench"},
    buildMirrorMesh};

}  // namespace
}  // namespace limen::scene
