// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "experiments/base/enum_names.h"
#include "renderer/scene/scene.h"
#include "renderer/visibility_fields/bounding_sphere.h"

namespace limen::visibility_fields {

/// What of a scene is one rigid object.
enum class ObjectForm {
  Parts,  ///< each part that is more than a receiver
  Pieces  ///< each piece of such a part: triangles connected by shared vertices
};
constexpr EnumNames<ObjectForm, 2> enumNames(ObjectForm) {
  return {{{{ObjectForm::Parts, "parts"}, {ObjectForm::Pieces, "pieces"}}}};
}

/// An object and the sphere around it. Its geometry is in units of the radius about the centre, so that
/// neither where it stands nor its size matters to its field.
struct RigidObject {
  std::string name;
  Sphere sphere;  ///< in the world; a little larger than the object, which nowhere touches it
  std::vector<glm::vec3> vertices;
  std::vector<glm::uvec3> triangles;
};

struct RigidObjects {
  std::vector<RigidObject> objects;
  std::vector<uint32_t> objectOf;  ///< of each triangle of the scene's mesh; kFieldNoObject: none
};

/// The finest level of the scene's objects. Triangles with a vertex that is not finite belong to none, and
/// neither do objects without extent.
RigidObjects rigidObjectsOf(const scene::Scene& scene, ObjectForm form);

/// `triangles` as an object of its own.
RigidObject makeRigidObject(std::string name, const std::vector<glm::dvec3>& positions,
                            const std::vector<glm::uvec3>& triangles);

}  // namespace limen::visibility_fields
