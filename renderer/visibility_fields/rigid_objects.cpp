// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/visibility_fields/rigid_objects.h"

#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "renderer/visibility_fields/field_bindings.h"

namespace limen::visibility_fields {
namespace {

/// Rays start this share of the radius outside of what they may hit.
constexpr double kClearance = 1e-5;

bool isFinite(glm::dvec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Sets of vertices that triangles connect.
class Connected {
 public:
  explicit Connected(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }
  uint32_t root(uint32_t of) {
    while (parent_[of] != of) of = parent_[of] = parent_[parent_[of]];
    return of;
  }
  /// The smaller number stays the root, so that pieces are in order of their vertices.
  void join(uint32_t a, uint32_t b) {
    a = root(a), b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<uint32_t> parent_;
};

}  // namespace

RigidObject makeRigidObject(std::string name, const std::vector<glm::dvec3>& positions,
                            const std::vector<glm::uvec3>& triangles) {
  RigidObject object;
  object.name = std::move(name);
  std::map<uint32_t, uint32_t> own;
  std::vector<glm::dvec3> used;
  for (const glm::uvec3 triangle : triangles) {
    glm::uvec3 mine;
    for (int corner = 0; corner < 3; ++corner) {
      const auto [at, fresh] = own.emplace(triangle[corner], static_cast<uint32_t>(used.size()));
      if (fresh) used.push_back(positions[triangle[corner]]);
      mine[corner] = at->second;
    }
    object.triangles.push_back(mine);
  }
  object.sphere = boundingSphere(used);
  object.sphere.radius *= 1.0 + kClearance;
  for (const glm::dvec3 p : used)
    object.vertices.emplace_back((p - object.sphere.centre) / object.sphere.radius);
  return object;
}

RigidObjects rigidObjectsOf(const scene::Scene& scene, ObjectForm form) {
  RigidObjects out;
  out.objectOf.assign(scene.mesh.triangles.size(), kFieldNoObject);
  for (const scene::Part& part : scene.parts) {
    if (part.receiverOnly) continue;
    std::vector<uint32_t> finite;
    Connected connected(form == ObjectForm::Pieces ? scene.mesh.positions.size() : 0);
    for (uint32_t i = part.firstTriangle; i < part.firstTriangle + part.triangleCount; ++i) {
      const glm::uvec3 t = scene.mesh.triangles[i];
      const auto& positions = scene.mesh.positions;
      if (!isFinite(positions[t.x]) || !isFinite(positions[t.y]) || !isFinite(positions[t.z])) continue;
      finite.push_back(i);
      if (form == ObjectForm::Pieces) connected.join(t.x, t.y), connected.join(t.x, t.z);
    }
    std::map<uint32_t, std::vector<uint32_t>> pieces;
    for (const uint32_t i : finite)
      pieces[form == ObjectForm::Pieces ? connected.root(scene.mesh.triangles[i].x) : 0].push_back(i);
    for (const auto& [root, numbers] : pieces) {
      std::vector<glm::uvec3> triangles;
      for (const uint32_t i : numbers) triangles.push_back(scene.mesh.triangles[i]);
      RigidObject object = makeRigidObject(part.name, scene.mesh.positions, triangles);
      if (!(object.sphere.radius > 0.0)) continue;
      for (const uint32_t i : numbers) out.objectOf[i] = static_cast<uint32_t>(out.objects.size());
      out.objects.push_back(std::move(object));
    }
  }
  return out;
}

}  // namespace limen::visibility_fields
