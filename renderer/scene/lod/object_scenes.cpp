// SPDX-License-Identifier: BSD-3-Clause
// Meshes in a few concrete levels on a ground plane, met by a moving camera: the first example of Schwarz
// 2009, section 10.3.5, and the objects of section 10.4.2. The thesis takes its levels from Direct3D 9's
// progressive meshes; here they are collapsed by meshoptimizer, each from the one before, which gives other
// triangles at the same counts.
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>

#include "experiments/base/error.h"
#include "renderer/scene/import.h"
#include "renderer/scene/lod/mesh_chain.h"
#include "renderer/scene/lod_scene_parameters.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

/// Chain of a mesh file, its finest level standing on y = 0 at the origin with height 1.
std::shared_ptr<const LodSet> makeChain(const std::string& path, const ParameterValues& values) {
  ImportedMesh imported = importMesh(path);
  standOnGround(imported.mesh, 1.0);
  std::vector<double> kept;
  const int64_t levels = values.integer("levels");
  for (int64_t i = 1; i < levels; ++i)
    kept.push_back(
        std::pow(1.0 - values.real("reduction"), static_cast<double>(i) / static_cast<double>(levels - 1)));
  const ChainNormals normals = values.text("level_normals") == "own" ? ChainNormals::Own : ChainNormals::Kept;
  return std::make_shared<const LodSet>(
      simplifiedChain(std::filesystem::path(path).stem().string(), imported.mesh, kept, normals));
}

/// The installed models do not change while a program runs, and a chain takes seconds: each is made once.
std::shared_ptr<const LodSet> installedChain(const std::string& model, const ParameterValues& values) {
  const std::string path = installedModel(model + (model == "bunny" ? ".obj" : ".3ds"));
  static std::mutex guard;
  static std::map<std::string, std::shared_ptr<const LodSet>> chains;
  const std::string key = path + "|" + toText(ParameterValue(values.integer("levels"))) + "|" +
                          toText(ParameterValue(values.real("reduction"))) + "|" +
                          values.text("level_normals");
  const std::scoped_lock lock(guard);
  std::shared_ptr<const LodSet>& chain = chains[key];
  if (!chain) chain = makeChain(path, values);
  return chain;
}

Material material(const std::string& name, glm::vec3 albedo, double contrast, double size,
                  glm::dvec3 origin) {
  Material out{name, albedo};
  if (contrast > 0.0) out.pattern = {Pattern::Kind::ValueNoise, size, contrast, 4, origin};
  return out;
}

/// Mean and largest extent of the objects are 1; they stand in rows that go away from the camera.
Scene stage(const LodSet& set, const ParameterValues& values) {
  Scene scene;
  Random random(values.integer("seed"));
  const auto shift = [&] {
    return glm::dvec3(random.uniform(-50.0, 50.0), random.uniform(-50.0, 50.0), random.uniform(-50.0, 50.0));
  };
  constexpr double kGroundSize = 60.0;
  addGround(scene, kGroundSize);
  scene.materials[0] =
      material("ground", scene.materials[0].albedo, values.real("ground_contrast"), 0.4, shift());
  const int64_t objects = values.integer("objects");
  const auto columns = static_cast<int64_t>(std::ceil(std::sqrt(static_cast<double>(objects))));
  const double spacing = values.real("spacing");
  for (int64_t i = 0; i < objects; ++i) {
    const auto column = static_cast<double>(i % columns) - 0.5 * static_cast<double>(columns - 1);
    Placement placement;
    placement.position = spacing * glm::dvec3(column, 0.0, -static_cast<double>(i / columns));
    if (i > 0)
      placement.position +=
          0.2 * spacing * glm::dvec3(random.uniform(-1.0, 1.0), 0.0, random.uniform(-1.0, 1.0));
    placement.yawDeg = i > 0 ? random.uniform(0.0, 360.0) : values.real("yaw_deg");
    addLodObject(scene, set, placement,
                 material(set.name, {0.62F, 0.6F, 0.56F}, values.real("object_contrast"), 0.15, shift()),
                 switchDistances(values, set.levels.size()));
  }
  const glm::dvec3 middle = scene.lodObjects[0].bounds.centre();
  scene.lights = {lightTowards(middle + glm::dvec3(-60.0, 70.0, 35.0), middle, glm::dvec2(4.0))};
  Ride ride = rideOf(values);
  ride.target = middle;
  ride.back = orbitCamera(glm::dvec3(0.0), 1.0, values.real("azimuth_deg"), 8.0).eye;
  ride.nearest = 0.75;
  setRide(scene, ride);
  return scene;
}

std::vector<Parameter> objectParameters(std::vector<Parameter> own) {
  const auto add = [&](std::vector<Parameter> more) { own.insert(own.end(), more.begin(), more.end()); };
  add({integerParameter("levels", 4, 2, 8, "", "Levels of detail, the mesh itself included"),
       realParameter("reduction", 0.88, 0.03, 0.99, "",
                     "Share of the triangles that the coarsest level lacks; the others lie between, each "
                     "smaller by the same factor",
                     "Schwarz 2009, section 10.4.2 (3 % to 88 %)"),
       choiceParameter(
           "level_normals", "kept", {"kept", "own"},
           "Normals of coarser levels: those of the mesh's vertices, or from their own triangles"),
       integerParameter("objects", 3, 1, 16, "", "Objects with levels"),
       realParameter("spacing", 2.0, 1.0, 10.0, "world units", "Between objects"),
       realParameter("yaw_deg", 0.0, -180.0, 180.0, "deg", "Turn of the first object"),
       realParameter("azimuth_deg", 0.0, -180.0, 180.0, "deg", "Of the eye around the first object"),
       realParameter("object_contrast", 0.0, 0.0, 1.0, "", "Contrast of the objects' solid texture"),
       realParameter("ground_contrast", 0.5, 0.0, 1.0, "", "Contrast of the ground's solid texture"),
       integerParameter("seed", 1, 0, 1000000, "", "Of places, turns and textures")});
  add(switchParameters(4.0, 100.0));
  add(rideParameters(6.0, 50.0, 1.0, 50.0));
  return own;
}

const Registered<SceneInfo> kObject{SceneInfo{
    .name = "lod/object",
    .version = 1,
    .summary = "Bunny or horse of height 1 in simplified levels on a textured ground, approached or passed",
    .source = "Schwarz 2009, sections 10.3.5 and 10.4.2",
    .parameters = objectParameters(
        {choiceParameter("model", "bunny", {"bunny", "horse"}, "Mesh (package glmark2-data)")}),
    .build = [](const ParameterValues& values) {
      return stage(*installedChain(values.text("model"), values), values);
    }}};

const Registered<SceneInfo> kLodMeshRegistered{
    SceneInfo{.name = "lod/mesh",
              .version = 1,
              .summary = "Like lod/object with a mesh from a file, scaled to height 1",
              .source = "bench",
              .parameters = objectParameters({fileParameter("file", "OBJ, PLY, glTF or 3DS file, y up")}),
              .build = [](const ParameterValues& values) {
                return stage(*makeChain(values.text("file"), values), values);
              }}};

}  // namespace
}  // namespace limen::scene
