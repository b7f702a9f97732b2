// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cassert>

#include "renderer/scene/placement.h"

namespace limen::scene {
namespace {

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

}  // namespace

const SettingsTable<NoSettings>& NoSettings::table() {
  static const SettingsTable<NoSettings> kTable = {};
  return kTable;
}

std::vector<Parameter> SceneInfo::allParameters() const {
  std::vector<Parameter> all = parameters;
  for (Parameter& parameter : PlacementSettings::table().parameters()) all.push_back(std::move(parameter));
  return all;
}

void SceneInfo::checkValues(const ParameterValues& complete) const {
  if (check) check(complete);
  PlacementSettings::table().read(complete);
}

Scene buildScene(const std::string& name, const ParameterValues& values) {
  const SceneInfo& info = SceneRegistry::instance().get(name);
  const std::string where = "scene '" + name + "'";
  const ParameterValues complete(info.allParameters(), values.all(), where);
  const PlacementSettings placement = PlacementSettings::table().read(complete);
  Scene scene = info.build(complete);
  scene.name = name;
  assert(wellFormed(scene));
  place(scene, placement, where);
  return scene;
}

}  // namespace limen::scene
