// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "renderer/scene/scene.h"
#include "renderer/scene/stage.h"

namespace limen::scene {

/// One concrete level of detail on its own, in object space.
struct LodMesh {
  Mesh mesh;                 ///< with morph targets towards the next coarser level, if the maker provides any
  double deviation = 0.0;    ///< see LodLevel::deviation
  double statedError = 0.0;  ///< see the maker
};

/// An object in a few concrete levels, finest first.
struct LodSet {
  std::string name;
  std::vector<LodMesh> levels;
};

/// Placement of an object: scaled, then rotated about y, then moved.
struct Placement {
  glm::dvec3 position{0.0};
  double yawDeg = 0.0;
  double scale = 1.0;
};

/// Adds an object of `set`: its finest level as a part of the scene, the others to Scene::coarser. Switch
/// distances as in LodObject.
void addLodObject(Scene& scene, const LodSet& set, const Placement& placement, const Material& material,
                  std::vector<double> switchDistances, Role role = Role::Caster);

/// What is shown of a scene: a level for each LOD object, and the background.
struct LodSelection {
  static constexpr int kOmitted = -1;  ///< the object is not drawn
  std::vector<int> levels;             ///< one per object of Scene::lodObjects
  bool background = true;              ///< parts that belong to no object
  bool operator==(const LodSelection&) const = default;
};

/// All objects at `level`, or at their coarsest if they have fewer.
LodSelection uniformLevels(const Scene& scene, int level);
inline LodSelection finestLevels(const Scene& scene) { return uniformLevels(scene, 0); }

/// The chosen triangles, each part or level a range. Throws Error if a level does not exist.
std::vector<TriangleRange> rangesOf(const Scene& scene, const LodSelection& selection);
uint64_t triangleCount(const Scene& scene, const LodSelection& selection);

/// The scene that a selection shows, without levels: for renderers that do not support them. Slow; copies.
Scene withLevels(const Scene& scene, const LodSelection& selection);

}  // namespace limen::scene
