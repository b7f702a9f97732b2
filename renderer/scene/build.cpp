// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cassert>
#include <cmath>

#include "experiments/base/error.h"
#include "renderer/scene/light.h"
#include "renderer/scene/scene.h"

namespace limen::scene {
namespace {

const char* const kAsBuilt = "as_built";

[[maybe_unused]] bool wellFormed(const Mesh& mesh) {
  const size_t vertices = mesh.positions.size();
  const auto fits = [&](size_t count) { return count == 0 || count == vertices; };
  if (!fits(mesh.normals.size()) || !fits(mesh.attributes.size()) || !fits(mesh.morphTargets.size()))
    return false;
  for (const glm::uvec3& triangle : mesh.triangles)
    for (int corner = 0; corner < 3; ++corner)
      if (triangle[corner] >= vertices) return false;
  return true;
}

/// The finest level is the object's part, the others lie in `coarser`, distances ascend.
[[maybe_unused]] bool wellFormed(const Scene& scene, const LodObject& object) {
  if (object.part >= scene.parts.size() || object.levels.empty()) return false;
  const Part& part = scene.parts[object.part];
  if (object.levels[0].firstTriangle != part.firstTriangle ||
      object.levels[0].triangleCount != part.triangleCount)
    return false;
  for (size_t i = 1; i < object.levels.size(); ++i)
    if (size_t{object.levels[i].firstTriangle} + object.levels[i].triangleCount >
        scene.coarser.triangles.size())
      return false;
  return object.switchDistances.size() + 1 == object.levels.size() &&
         std::is_sorted(object.switchDistances.begin(), object.switchDistances.end());
}

/// The parts tile the triangles in order and name what exists; lights and cameras are usable.
[[maybe_unused]] bool wellFormed(const Scene& scene) {
  size_t next = 0;
  for (const Part& part : scene.parts) {
    if (part.firstTriangle != next || part.material >= scene.materials.size()) return false;
    next += part.triangleCount;
  }
  if (!wellFormed(scene.mesh) || !wellFormed(scene.coarser)) return false;
  for (const LodObject& object : scene.lodObjects)
    if (!wellFormed(scene, object)) return false;
  for (const Material& material : scene.materials)
    if (material.surface == SurfaceKind::BicubicPatch && material.patch >= scene.patches.size()) return false;
  return next == scene.mesh.triangles.size() && !scene.camera.keys.empty();
}

/// Applies `map` to every position of the world: geometry, lights, cameras.
template <class Map>
void mapWorld(Scene& scene, Map map) {
  for (Mesh* mesh : {&scene.mesh, &scene.coarser}) {
    for (glm::dvec3& position : mesh->positions) position = map(position);
    for (glm::dvec3& target : mesh->morphTargets) target = map(target);
  }
  for (LodObject& object : scene.lodObjects)
    object.bounds = {map(object.bounds.low), map(object.bounds.high)};
  for (AreaLight& light : scene.lights) light.centre = map(light.centre);
  for (Material& material : scene.materials) material.pattern.origin = map(material.pattern.origin);
  for (BicubicPatch& patch : scene.patches)
    for (glm::dvec3& point : patch.points) point = map(point);
  for (CameraPath::Key& key : scene.camera.keys) {
    key.camera.eye = map(key.camera.eye);
    key.camera.target = map(key.camera.target);
  }
}

LightShape shapeNamed(const std::string& name) {
  if (name == "rectangle") return LightShape::Rectangle;
  if (name == "disc") return LightShape::Disc;
  assert(name == "polygon");
  return LightShape::Polygon;
}

}  // namespace

std::vector<Parameter> commonParameters() {
  Parameter camera = textParameter(
      "camera", "",
      "View in place of the scene's own, in the built world's units: eye X Y Z target X Y Z [up X Y Z] "
      "[fov DEGREES]");
  Parameter path = optionalFileParameter("camera_path", "Camera path in place of the scene's own");
  // Results are older than these two.
  camera.keyedIfGiven = path.keyedIfGiven = true;
  return {
      realParameter("scale", 1.0, 1e-6, 1e6, "", "Scales the whole world about the origin"),
      realParameter("offset", 0.0, 0.0, 1e6, "scene diagonals", "Moves the whole world along (1,1,1)"),
      realParameter("light_size", 1.0, 0.001, 100.0, "", "Multiplies the light's extents",
                    "Schwarz 2009, chapters 3 to 5"),
      choiceParameter("light_shape", kAsBuilt, {kAsBuilt, "rectangle", "disc", "polygon"},
                      "Shape of the light within its extents; polygon: a hexagon"),
      realParameter("time_s", 0.0, 0.0, 3600.0, "s",
                    "Position on the camera path; past its end the camera rests"),
      camera,
      path,
  };
}

std::vector<Parameter> SceneInfo::allParameters() const {
  std::vector<Parameter> all = parameters;
  for (Parameter& parameter : commonParameters()) all.push_back(std::move(parameter));
  return all;
}

Scene buildScene(const std::string& name, const ParameterValues& values) {
  const SceneInfo& info = SceneRegistry::instance().get(name);
  const std::string where = "scene '" + name + "'";
  const ParameterValues complete(info.allParameters(), values.all(), where);
  Scene scene = info.build(complete);
  scene.name = name;
  assert(wellFormed(scene));

  const double scale = complete.real("scale");
  if (scale != 1.0) {
    mapWorld(scene, [&](glm::dvec3 p) { return p * scale; });
    for (AreaLight& light : scene.lights) light.size *= scale;
    for (Material& material : scene.materials) material.pattern.size *= scale;
    for (LodObject& object : scene.lodObjects) {
      for (LodLevel& level : object.levels) level.deviation *= scale, level.statedError *= scale;
      for (double& distance : object.switchDistances) distance *= scale;
    }
  }
  if (const double offset = complete.real("offset"); offset != 0.0) {
    const glm::dvec3 shift(offset * scene.bounds().diagonal() / std::sqrt(3.0));
    mapWorld(scene, [&](glm::dvec3 p) { return p + shift; });
  }
  const std::string& shape = complete.text("light_shape");
  for (AreaLight& light : scene.lights) {
    light.size *= complete.real("light_size");
    if (shape != kAsBuilt) light = withShape(std::move(light), shapeNamed(shape));
    checkLight(light, where);
  }
  scene.camera = cameraFor(scene.camera, complete);
  return scene;
}

}  // namespace limen::scene
