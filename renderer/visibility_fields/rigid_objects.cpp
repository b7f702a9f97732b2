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

const SettingsTable<AutoObjects>& AutoObjects::table() {
  static const SettingsTable<AutoObjects> kTable = {
      {&AutoObjects::mostPieces,
       "most_pieces",
       {1, 256},
       "",
       "Pieces of a part that have a field each; a part of more is one object. A field takes positions x "
       "directions x "
       "directions x bits / 8 bytes"}};
  return kTable;
}

const SettingsTable<PartObjects>& PartObjects::table() {
  static const SettingsTable<PartObjects> kTable = {};
  return kTable;
}

const SettingsTable<PieceObjects>& PieceObjects::table() {
  static const SettingsTable<PieceObjects> kTable = {};
  return kTable;
}

const scene::PartMotion* motionOf(const scene::Scene& scene, const RigidObject& object) {
  for (const scene::PartMotion& motion : scene.motions)
    if (motion.part == object.part) return &motion;
  return nullptr;
}

RigidObject makeRigidObject(std::string name, const std::vector<glm::dvec3>& positions,
                            const std::vector<glm::uvec3>& triangles, const std::vector<glm::vec3>& normals) {
  RigidObject object;
  object.name = std::move(name);
  std::map<uint32_t, uint32_t> own;
  std::vector<glm::dvec3> used;
  for (const glm::uvec3 triangle : triangles) {
    glm::uvec3 mine;
    for (int corner = 0; corner < 3; ++corner) {
      const auto [at, fresh] = own.emplace(triangle[corner], static_cast<uint32_t>(used.size()));
      if (fresh) used.push_back(positions[triangle[corner]]);
      if (fresh && !normals.empty()) object.normals.push_back(normals[triangle[corner]]);
      mine[corner] = at->second;
    }
    object.numbers.push_back(static_cast<uint32_t>(object.triangles.size()));
    object.triangles.push_back(mine);
  }
  object.sphere = boundingSphere(used);
  object.sphere.radius *= 1.0 + kClearance;
  for (const glm::dvec3 p : used)
    object.vertices.emplace_back((p - object.sphere.centre) / object.sphere.radius);
  return object;
}

namespace {

/// Numbers of a part's triangles whose vertices are finite.
std::vector<uint32_t> finiteTriangles(const scene::Mesh& mesh, const scene::Part& part) {
  std::vector<uint32_t> finite;
  for (uint32_t i = part.firstTriangle; i < part.firstTriangle + part.triangleCount; ++i) {
    const glm::uvec3 t = mesh.triangles[i];
    if (isFinite(mesh.positions[t.x]) && isFinite(mesh.positions[t.y]) && isFinite(mesh.positions[t.z]))
      finite.push_back(i);
  }
  return finite;
}

using Triangles = std::vector<uint32_t>;

std::vector<Triangles> connectedPieces(const scene::Mesh& mesh, const Triangles& all) {
  Connected connected(mesh.positions.size());
  for (const uint32_t i : all) {
    const glm::uvec3 t = mesh.triangles[i];
    connected.join(t.x, t.y), connected.join(t.x, t.z);
  }
  std::map<uint32_t, Triangles> pieces;
  for (const uint32_t i : all) pieces[connected.root(mesh.triangles[i].x)].push_back(i);
  std::vector<Triangles> out;
  for (auto& [root, piece] : pieces) out.push_back(std::move(piece));
  return out;
}

}  // namespace

RigidObjects rigidObjectsOf(const scene::Scene& scene, const ObjectSetting& setting) {
  RigidObjects out;
  out.objectOf.assign(scene.mesh.triangles.size(), kFieldNoObject);
  size_t partsLeft = 0;
  for (const scene::Part& part : scene.parts) partsLeft += part.receiverOnly ? 0 : 1;
  for (const scene::Part& part : scene.parts) {
    if (part.receiverOnly) continue;
    --partsLeft;
    const Triangles finite = finiteTriangles(scene.mesh, part);
    if (finite.empty()) continue;
    std::vector<Triangles> pieces = {finite};
    if (!std::holds_alternative<PartObjects>(setting)) {
      std::vector<Triangles> each = connectedPieces(scene.mesh, finite);
      const auto* few = std::get_if<AutoObjects>(&setting);
      if (!few || (each.size() <= static_cast<size_t>(few->mostPieces) &&
                   out.objects.size() + each.size() + partsLeft <= kMostFieldObjects))
        pieces = std::move(each);
    }
    for (const Triangles& numbers : pieces) {
      std::vector<glm::uvec3> triangles;
      for (const uint32_t i : numbers) triangles.push_back(scene.mesh.triangles[i]);
      RigidObject object = makeRigidObject(part.name, scene.mesh.positions, triangles, scene.mesh.normals);
      if (!(object.sphere.radius > 0.0)) continue;
      object.albedo = scene.materials[part.material].albedo;
      object.numbers = numbers;
      object.part = static_cast<uint32_t>(&part - scene.parts.data());
      object.owner = static_cast<uint32_t>(out.objects.size());
      for (const uint32_t i : numbers) out.objectOf[i] = object.owner;
      out.objects.push_back(std::move(object));
    }
  }
  return out;
}

}  // namespace limen::visibility_fields
