// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/visibility_fields/field_scene.h"

#include <string>

#include "experiments/base/error.h"
#include "renderer/visibility_fields/field_bindings.h"

namespace limen::techniques {
namespace vf = visibility_fields;

vf::RigidObjects objectsOf(const frame::Frame& frame, vf::ObjectForm form) {
  vf::RigidObjects objects = vf::rigidObjectsOf(frame.scene(), form);
  if (objects.objects.size() > kMostFieldObjects)
    throw Error("the scene has " + std::to_string(objects.objects.size()) + " objects; at most " +
                    std::to_string(kMostFieldObjects) + " can have visibility fields",
                "objects", "use 'parts', or a smaller scene");
  return objects;
}

vf::VisibilityFields fieldsOf(frame::Frame& frame, const vf::RigidObjects& objects,
                              const vf::FieldForm& form) {
  vf::VisibilityFields fields(frame.context(), objects.objects, form);
  std::vector<vf::Pose> poses;
  for (const vf::RigidObject& object : objects.objects) poses.push_back(vf::VisibilityFields::poseOf(object));
  fields.place(poses, frame.gpuScene().anchor());
  return fields;
}

ray_tracing::RayScene objectRays(frame::Frame& frame, const vf::RigidObjects& objects) {
  const scene::Mesh& mesh = frame.scene().mesh;
  std::vector<glm::vec3> vertices;
  for (const glm::dvec3 p : mesh.positions) vertices.emplace_back(p - frame.gpuScene().anchor());
  std::vector<glm::uvec3> triangles = mesh.triangles;
  // Without area: left out of the tree, but counted.
  for (size_t i = 0; i < triangles.size(); ++i)
    if (objects.objectOf[i] == vf::kFieldNoObject) triangles[i] = glm::uvec3(0);
  return {frame.context(), vertices, triangles};
}

gl::Buffer objectOfBuffer(const vf::RigidObjects& objects) { return gl::Buffer(objects.objectOf); }

}  // namespace limen::techniques
