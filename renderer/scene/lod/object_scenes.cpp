// SPDX-License-Identifier: BSD-3-Clause
// Meshes in a few discrete levels on a ground plane, approached by a moving camera: the first example of
// Schwarz 2009, section 10.3.5, and the objects of section 10.4.2. The thesis takes its levels from Direct3D
// 9's progressive meshes; here they are collapsed by meshoptimizer, each from the one before, which gives
// other triangles at the same counts.
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <tuple>

#include "experiments/base/error.h"
#include "renderer/scene/import.h"
#include "renderer/scene/lod/mesh_chain.h"
#include "renderer/scene/lod_scene_parameters.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

struct ChainSettings {
  int count = 4;
  double reduction = 0.88;
  ChainNormals normals = ChainNormals::Kept;
  static const SettingsTable<ChainSettings>& table() {
    using S = ChainSettings;
    static const SettingsTable<S> kTable = {
        {&S::count, "count", {2, 8}, "", "Levels of detail, including the mesh itself"},
        Binding(&S::reduction, "reduction", Range{0.03, 0.99}, "",
                "Share of the triangles that the coarsest level lacks; the others lie between, each smaller "
                "by the same factor",
                "Schwarz 2009, section 10.4.2 (3 % to 88 %)")
            .formerly({"reduction"}),
        Binding(
            &S::normals, "normals",
            "Normals of coarser levels: those of the mesh's vertices, or recomputed from their own triangles")
            .formerly({"level_normals"})};
    return kTable;
  }
};

struct RowSettings {
  int64_t count = 3;
  double spacing = 2.0;
  static const SettingsTable<RowSettings>& table() {
    using S = RowSettings;
    static const SettingsTable<S> kTable = {
        {&S::count, "count", {1, 16}, "", "Number of objects with levels of detail"},
        Binding(&S::spacing, "spacing", Range{1.0, 10.0}, "world units", "Distance between objects")
            .formerly({"spacing"})};
    return kTable;
  }
};

/// What lod/object and lod/mesh have in common.
struct ShowSettings {
  ChainSettings levels;
  RowSettings objects;
  double yawDeg = 0.0, azimuthDeg = 0.0;
  double objectContrast = 0.0, groundContrast = 0.5;
  int64_t seed = 1;
  SwitchSettings switching{.distance = 4.0};
  double distance = 6.0;
  CameraMotion motion = Approach{.speed = 1.0};
  static const SettingsTable<ShowSettings>& table() {
    using S = ShowSettings;
    static const SettingsTable<S> kTable = {
        Binding(&S::levels, "levels", "Levels of detail by edge collapse").shorthand("count"),
        Binding(&S::objects, "objects", "How many objects, and how far apart").shorthand("count"),
        {&S::yawDeg, "yaw_deg", {-180.0, 180.0}, "deg", "Rotation of the first object"},
        {&S::azimuthDeg, "azimuth_deg", {-180.0, 180.0}, "deg", "Azimuth of the eye around the first object"},
        {&S::objectContrast, "object_contrast", {0.0, 1.0}, "", "Contrast of the objects' solid texture"},
        {&S::groundContrast, "ground_contrast", {0.0, 1.0}, "", "Contrast of the ground's solid texture"},
        {&S::seed, "seed", {0, 1000000}, "", "Seed of positions, rotations and textures"},
        switchBinding(&S::switching),
        distanceBinding(&S::distance, 50.0),
        motionBinding(&S::motion)};
    return kTable;
  }
};

enum class Model { Bunny, Horse };
constexpr EnumNames<Model, 2> enumNames(Model) {
  return {{{{Model::Bunny, "bunny"}, {Model::Horse, "horse"}}}};
}

struct ObjectSettings {
  Model model = Model::Bunny;
  ShowSettings show;
  static const SettingsTable<ObjectSettings>& table() {
    using S = ObjectSettings;
    static const SettingsTable<S> kTable = {{&S::model, "model", "Mesh (package glmark2-data)"},
                                            included(&S::show)};
    return kTable;
  }
};

struct LodMeshSettings {
  FilePath file;
  ShowSettings show;
  static const SettingsTable<LodMeshSettings>& table() {
    using S = LodMeshSettings;
    static const SettingsTable<S> kTable = {
        {&S::file, "file", FileIs::Required, "OBJ, PLY, glTF or 3DS file, y up"}, included(&S::show)};
    return kTable;
  }
};

/// Chain of a mesh file, its finest level standing on y = 0 at the origin with height 1.
std::shared_ptr<const LodSet> makeChain(const std::string& path, const ChainSettings& settings) {
  ImportedMesh imported = importMesh(path);
  standOnGround(imported.mesh, 1.0);
  std::vector<double> kept;
  for (int i = 1; i < settings.count; ++i)
    kept.push_back(
        std::pow(1.0 - settings.reduction, static_cast<double>(i) / static_cast<double>(settings.count - 1)));
  return std::make_shared<const LodSet>(
      simplifiedChain(std::filesystem::path(path).stem().string(), imported.mesh, kept, settings.normals));
}

/// The installed models do not change while a program runs, and a chain takes seconds: each is made once.
std::shared_ptr<const LodSet> installedChain(Model model, const ChainSettings& settings) {
  const std::string path = installedModel(model == Model::Bunny ? "bunny.obj" : "horse.3ds");
  static std::mutex guard;
  static std::map<std::tuple<Model, int, double, ChainNormals>, std::shared_ptr<const LodSet>> chains;
  const std::scoped_lock lock(guard);
  std::shared_ptr<const LodSet>& chain =
      chains[{model, settings.count, settings.reduction, settings.normals}];
  if (!chain) chain = makeChain(path, settings);
  return chain;
}

Material material(const std::string& name, glm::vec3 albedo, double contrast, double size,
                  glm::dvec3 origin) {
  Material out{name, albedo};
  if (contrast > 0.0) out.pattern = {Pattern::Kind::ValueNoise, size, contrast, 4, origin};
  return out;
}

/// Mean and largest extent of the objects are 1; they stand in rows that go away from the camera.
Scene stage(const LodSet& set, const ShowSettings& settings) {
  Scene scene;
  Random random(settings.seed);
  const auto shift = [&] {
    return glm::dvec3(random.uniform(-50.0, 50.0), random.uniform(-50.0, 50.0), random.uniform(-50.0, 50.0));
  };
  constexpr double kGroundSize = 60.0;
  addGround(scene, kGroundSize);
  scene.materials[0] = material("ground", scene.materials[0].albedo, settings.groundContrast, 0.4, shift());
  const int64_t objects = settings.objects.count;
  const auto columns = static_cast<int64_t>(std::ceil(std::sqrt(static_cast<double>(objects))));
  const double spacing = settings.objects.spacing;
  for (int64_t i = 0; i < objects; ++i) {
    const auto column = static_cast<double>(i % columns) - 0.5 * static_cast<double>(columns - 1);
    Placement placement;
    placement.position = spacing * glm::dvec3(column, 0.0, -static_cast<double>(i / columns));
    if (i > 0)
      placement.position +=
          0.2 * spacing * glm::dvec3(random.uniform(-1.0, 1.0), 0.0, random.uniform(-1.0, 1.0));
    placement.yawDeg = i > 0 ? random.uniform(0.0, 360.0) : settings.yawDeg;
    addLodObject(scene, set, placement,
                 material(set.name, {0.62F, 0.6F, 0.56F}, settings.objectContrast, 0.15, shift()),
                 settings.switching.distances(set.levels.size()));
  }
  const glm::dvec3 middle = scene.lodObjects[0].bounds.centre();
  scene.lights = {lightTowards(middle + glm::dvec3(-60.0, 70.0, 35.0), middle, glm::dvec2(4.0))};
  Ride ride;
  ride.distance = settings.distance;
  ride.target = middle;
  ride.back = orbitCamera(glm::dvec3(0.0), 1.0, settings.azimuthDeg, 8.0).eye;
  ride.nearest = 0.75;
  setRide(scene, ride, settings.motion);
  return scene;
}

const RegisteredScene<ObjectSettings> kObject{
    {.name = "lod/object",
     .version = 1,
     .summary = "Bunny or horse of height 1 in simplified levels on a textured ground, approached or passed",
     .source = "Schwarz 2009, sections 10.3.5 and 10.4.2"},
    [](const ObjectSettings& settings) {
      return stage(*installedChain(settings.model, settings.show.levels), settings.show);
    }};

const RegisteredScene<LodMeshSettings> kLodMeshRegistered{
    {.name = "lod/mesh",
     .version = 1,
     .summary = "Like lod/object with a mesh from a file, scaled to height 1",
     .source = "bench"},
    [](const LodMeshSettings& settings) {
      return stage(*makeChain(settings.file.path, settings.show.levels), settings.show);
    }};

}  // namespace
}  // namespace limen::scene
