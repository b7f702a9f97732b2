// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/mirrors/mirror_parts.h"

#include <array>
#include <cmath>
#include <numbers>

#include "renderer/scene/lod/mesh_chain.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {

const SettingsTable<ObjectsInMotion>& ObjectsInMotion::table() {
  using S = ObjectsInMotion;
  static const SettingsTable<S> kTable = {
      {&S::timeS, "time_s", {0.0, 3600.0}, "s", "Time of the motion at the first frame"},
      {&S::speed, "speed", {0.0, 100.0}, "", "Multiplies all speeds"}};
  return kTable;
}

void moveLastPart(Scene& scene, const ObjectMotion& choice, PartMotion motion) {
  const auto* moving = std::get_if<ObjectsInMotion>(&choice);
  if (!moving || moving->speed == 0.0) return;
  motion.part = static_cast<uint32_t>(scene.parts.size() - 1);
  motion.startS = moving->timeS;
  motion.turnDegS *= moving->speed;
  motion.periodS /= moving->speed;
  scene.motions.push_back(motion);
}

Material mirrorMaterial(double reflectance, double glossRad) {
  Material material;
  material.name = "mirror";
  material.albedo = glm::vec3(0.02F);
  material.mirror = glm::vec3(static_cast<float>(reflectance));
  material.glossRad = static_cast<float>(glossRad);
  return material;
}

void addCheckeredGround(Scene& scene, double size, double square) {
  addGround(scene, size);
  Pattern& pattern = scene.materials.back().pattern;
  pattern.kind = Pattern::Kind::Checker;
  pattern.size = square;
  pattern.origin.y = 0.5 * square;  // the floor lies within cells, not between them
}

Mesh ellipsoid(glm::dvec3 centre, glm::dvec3 semiAxes, int cells) {
  Mesh mesh = sphere(glm::dvec3(0.0), 1.0, cells);
  for (glm::dvec3& position : mesh.positions) {
    mesh.normals.emplace_back(glm::normalize(position / semiAxes));
    position = centre + position * semiAxes;
  }
  return mesh;
}

Mesh lathe(glm::dvec3 base, std::span<const glm::dvec2> profile, int segments) {
  Mesh mesh;
  const auto n = static_cast<uint32_t>(segments);
  const auto rings = static_cast<uint32_t>(profile.size());
  for (const glm::dvec2& at : profile)
    for (uint32_t i = 0; i < n; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / n;
      mesh.positions.push_back(base + glm::dvec3(at.x * std::cos(angle), at.y, -at.x * std::sin(angle)));
    }
  for (uint32_t ring = 0; ring + 1 < rings; ++ring) {
    if (profile[ring] == profile[ring + 1]) continue;
    for (uint32_t i = 0; i < n; ++i) {
      const uint32_t a = ring * n + i, b = ring * n + (i + 1) % n, c = a + n, d = b + n;
      if (profile[ring].x > 0.0) mesh.triangles.emplace_back(a, b, d);
      if (profile[ring + 1].x > 0.0) mesh.triangles.emplace_back(a, d, c);
    }
  }
  mesh.normals = vertexNormals(mesh);
  return mesh;
}

Mesh heightSheet(glm::dvec3 centre, double size, int cells,
                 const std::function<double(double, double)>& height,
                 const std::function<glm::dvec2(double, double)>& slope) {
  Mesh mesh = planeGrid(glm::dvec3(0.0), size, size, cells);
  for (glm::dvec3& position : mesh.positions) {
    const glm::dvec2 gradient = slope(position.x, position.z);
    mesh.normals.emplace_back(glm::normalize(glm::dvec3(-gradient.x, 1.0, -gradient.y)));
    position = centre + glm::dvec3(position.x, height(position.x, position.z), position.z);
  }
  return mesh;
}

Mesh statue(int cells) {
  struct Limb {
    glm::dvec3 centre, semiAxes;
  };
  constexpr std::array<Limb, 9> kLimbs = {{{{0.0, 0.91, 0.0}, {0.065, 0.09, 0.075}},
                                           {{0.0, 0.66, 0.0}, {0.13, 0.2, 0.085}},
                                           {{0.0, 0.48, 0.0}, {0.12, 0.11, 0.09}},
                                           {{-0.065, 0.24, 0.0}, {0.06, 0.25, 0.065}},
                                           {{0.065, 0.24, 0.02}, {0.06, 0.25, 0.065}},
                                           {{-0.18, 0.6, 0.03}, {0.04, 0.2, 0.045}},
                                           {{0.18, 0.7, 0.09}, {0.045, 0.1, 0.14}},
                                           {{-0.065, 0.025, 0.05}, {0.05, 0.025, 0.1}},
                                           {{0.065, 0.025, 0.07}, {0.05, 0.025, 0.1}}}};
  Mesh mesh;
  for (const Limb& limb : kLimbs) append(mesh, ellipsoid(limb.centre, limb.semiAxes, cells));
  return mesh;
}

Mesh movedMesh(Mesh mesh, double scale, double turnDeg, glm::dvec3 to) {
  const double c = std::cos(glm::radians(turnDeg)), s = std::sin(glm::radians(turnDeg));
  const auto turned = [&](glm::dvec3 v) { return glm::dvec3(c * v.x + s * v.z, v.y, c * v.z - s * v.x); };
  for (glm::dvec3& position : mesh.positions) position = to + scale * turned(position);
  for (glm::vec3& normal : mesh.normals) normal = turned(normal);
  return mesh;
}

void setMovingCamera(Scene& scene, const Camera& from, const Camera& to, double seconds) {
  scene.camera.keys = {{0.0, from}, {seconds, to}};
}

}  // namespace limen::scene
