// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/lod_set.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "experiments/base/error.h"
#include "renderer/scene/shapes.h"

namespace limen::scene {
namespace {

Mesh placed(Mesh mesh, const Placement& placement) {
  const double yaw = glm::radians(placement.yawDeg), c = std::cos(yaw), s = std::sin(yaw);
  const auto turned = [&](auto v) {
    using Value = decltype(v.x);
    return decltype(v)(static_cast<Value>(c * v.x + s * v.z), v.y, static_cast<Value>(c * v.z - s * v.x));
  };
  const auto moved = [&](glm::dvec3 p) { return placement.position + placement.scale * turned(p); };
  for (glm::dvec3& position : mesh.positions) position = moved(position);
  for (glm::dvec3& target : mesh.morphTargets) target = moved(target);
  for (glm::vec3& normal : mesh.normals) normal = turned(normal);
  return mesh;
}

/// The triangles [first, first + count) of `from` as a separate mesh.
Mesh cut(const Mesh& from, uint32_t first, uint32_t count) {
  Mesh out;
  std::vector<uint32_t> moved(from.positions.size(), 0xffffffffU);
  for (uint32_t t = first; t < first + count; ++t) {
    glm::uvec3 triangle = from.triangles[t];
    for (int corner = 0; corner < 3; ++corner) {
      uint32_t& index = moved[triangle[corner]];
      if (index == 0xffffffffU) {
        index = static_cast<uint32_t>(out.positions.size());
        out.positions.push_back(from.positions[triangle[corner]]);
        if (!from.normals.empty()) out.normals.push_back(from.normals[triangle[corner]]);
        if (!from.attributes.empty()) out.attributes.push_back(from.attributes[triangle[corner]]);
      }
      triangle[corner] = index;
    }
    out.triangles.push_back(triangle);
  }
  return out;
}

/// Level of each part: that of its object, 0 for background, kOmitted for what is not shown.
std::vector<int> levelOfParts(const Scene& scene, const LodSelection& selection) {
  if (selection.levels.size() != scene.lodObjects.size())
    throw Error("a selection of " + std::to_string(selection.levels.size()) + " levels for " +
                    std::to_string(scene.lodObjects.size()) + " objects",
                "scene '" + scene.name + "'", "give one level per object");
  std::vector<int> levels(scene.parts.size(), selection.background ? 0 : LodSelection::kOmitted);
  for (size_t i = 0; i < scene.lodObjects.size(); ++i) {
    const LodObject& object = scene.lodObjects[i];
    const int level = selection.levels[i];
    if (level < LodSelection::kOmitted || level >= static_cast<int>(object.levels.size()))
      throw Error("object '" + object.name + "' has no level " + std::to_string(level),
                  "scene '" + scene.name + "'",
                  "choose 0 to " + std::to_string(object.levels.size() - 1) + ", or -1 to leave it out");
    levels[object.part] = level;
  }
  return levels;
}

std::vector<const LodObject*> objectOfParts(const Scene& scene) {
  std::vector<const LodObject*> out(scene.parts.size(), nullptr);
  for (const LodObject& object : scene.lodObjects) out[object.part] = &object;
  return out;
}

}  // namespace

void addLodObject(Scene& scene, const LodSet& set, const Placement& placement, const Material& material,
                  std::vector<double> switchDistances, Role role) {
  assert(!set.levels.empty() && switchDistances.size() + 1 == set.levels.size());
  LodObject object;
  object.name = set.name;
  object.part = static_cast<uint32_t>(scene.parts.size());
  object.switchDistances = std::move(switchDistances);
  for (size_t i = 0; i < set.levels.size(); ++i) {
    const LodMesh& level = set.levels[i];
    const Mesh mesh = placed(level.mesh, placement);
    Mesh& to = i == 0 ? scene.mesh : scene.coarser;
    object.levels.push_back({static_cast<uint32_t>(to.triangles.size()),
                             static_cast<uint32_t>(mesh.triangles.size()), level.deviation * placement.scale,
                             level.statedError * placement.scale});
    append(to, mesh);
    for (const glm::dvec3& position : mesh.positions) object.bounds.extend(position);
  }
  Part part;
  part.name = set.name;
  part.firstTriangle = object.levels[0].firstTriangle;
  part.triangleCount = object.levels[0].triangleCount;
  part.material = static_cast<uint32_t>(scene.materials.size());
  part.receiverOnly = role == Role::ReceiverOnly;
  scene.parts.push_back(std::move(part));
  scene.materials.push_back(material);
  scene.lodObjects.push_back(std::move(object));
}

LodSelection uniformLevels(const Scene& scene, int level) {
  LodSelection out;
  for (const LodObject& object : scene.lodObjects)
    out.levels.push_back(std::clamp(level, 0, static_cast<int>(object.levels.size()) - 1));
  return out;
}

std::vector<TriangleRange> rangesOf(const Scene& scene, const LodSelection& selection) {
  const std::vector<int> levels = levelOfParts(scene, selection);
  const std::vector<const LodObject*> objects = objectOfParts(scene);
  std::vector<TriangleRange> out;
  for (size_t i = 0; i < scene.parts.size(); ++i) {
    if (levels[i] == LodSelection::kOmitted) continue;
    out.push_back(objects[i] ? scene.triangles(*objects[i], levels[i])
                             : TriangleRange{scene.parts[i].firstTriangle, scene.parts[i].triangleCount});
  }
  return out;
}

uint64_t triangleCount(const Scene& scene, const LodSelection& selection) {
  uint64_t sum = 0;
  for (const TriangleRange& range : rangesOf(scene, selection)) sum += range.count;
  return sum;
}

Scene withLevels(const Scene& scene, const LodSelection& selection) {
  const std::vector<int> levels = levelOfParts(scene, selection);
  const std::vector<const LodObject*> objects = objectOfParts(scene);
  Scene out = scene;
  out.mesh = {};
  out.coarser = {};
  out.parts.clear();
  out.lodObjects.clear();
  for (size_t i = 0; i < scene.parts.size(); ++i) {
    if (levels[i] == LodSelection::kOmitted) continue;
    const bool coarse = levels[i] > 0;
    const uint32_t first = coarse ? objects[i]->levels[static_cast<size_t>(levels[i])].firstTriangle
                                  : scene.parts[i].firstTriangle;
    const uint32_t count = coarse ? objects[i]->levels[static_cast<size_t>(levels[i])].triangleCount
                                  : scene.parts[i].triangleCount;
    Part part = scene.parts[i];
    part.firstTriangle = static_cast<uint32_t>(out.mesh.triangles.size());
    part.triangleCount = count;
    append(out.mesh, cut(coarse ? scene.coarser : scene.mesh, first, count));
    out.parts.push_back(std::move(part));
  }
  return out;
}

}  // namespace limen::scene
