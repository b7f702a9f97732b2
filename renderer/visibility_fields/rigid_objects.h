// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <variant>
#include <vector>

#include "experiments/base/settings_table.h"
#include "renderer/scene/scene.h"
#include "renderer/visibility_fields/bounding_sphere.h"

namespace limen::visibility_fields {

/// Most objects of a scene that have fields.
inline constexpr size_t kMostFieldObjects = 256;

/// What of a scene is one rigid object.
struct AutoObjects {
  static constexpr const char *kKind = "auto",
                              *kSummary =
                                  "the pieces of a part that has few of them, and whole parts otherwise";
  /// Parts of more pieces are one object; so are those that would bring the scene beyond kMostFieldObjects.
  int mostPieces = 32;
  static const SettingsTable<AutoObjects>& table();
};
struct PartObjects {
  static constexpr const char *kKind = "parts", *kSummary = "each part that is more than a receiver";
  static const SettingsTable<PartObjects>& table();
};
struct PieceObjects {
  static constexpr const char *kKind = "pieces",
                              *kSummary = "each piece of a part: triangles connected by shared vertices";
  static const SettingsTable<PieceObjects>& table();
};
using ObjectSetting = std::variant<AutoObjects, PartObjects, PieceObjects>;

/// An object and the sphere around it. Its geometry is in units of the radius about the centre, so that
/// neither where it stands nor its size matters to its field.
struct RigidObject {
  std::string name;
  Sphere sphere;  ///< in the world; a little larger than the object, which nowhere touches it
  std::vector<glm::vec3> vertices;
  std::vector<glm::uvec3> triangles;
  std::vector<uint32_t> numbers;   ///< of the triangles in the scene, or whatever they were made from
  std::vector<glm::vec3> normals;  ///< for shading, of the vertices; empty: those of the triangles
  glm::vec3 albedo{0.7F};          ///< of its part, without a pattern
  uint32_t part = 0;               ///< of the scene that it is, or a piece of
  uint32_t owner = 0;              ///< number of the rigid object that this is, or a part of (sphere_cover.h)
};

struct RigidObjects {
  std::vector<RigidObject> objects;
  std::vector<uint32_t> objectOf;  ///< owner of each triangle of the scene's mesh; kFieldNoObject: none
};

/// The finest level of the scene's objects. Triangles with a vertex that is not finite belong to none, and
/// neither do objects without extent.
RigidObjects rigidObjectsOf(const scene::Scene& scene, const ObjectSetting& setting);

/// How the object moves; null: it rests.
const scene::PartMotion* motionOf(const scene::Scene& scene, const RigidObject& object);

/// `triangles` as an object of its own, numbered in their order.
RigidObject makeRigidObject(std::string name, const std::vector<glm::dvec3>& positions,
                            const std::vector<glm::uvec3>& triangles,
                            const std::vector<glm::vec3>& normals = {});

}  // namespace limen::visibility_fields
