// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/stage.h"

#include <algorithm>
#include <cmath>

#include "renderer/scene/shapes.h"

namespace limen::scene {
namespace {

constexpr glm::vec3 kGroundAlbedo{0.6F, 0.6F, 0.58F};
constexpr int kGroundCells = 32;

}  // namespace

void addPart(Scene& scene, const std::string& name, const Mesh& mesh, glm::vec3 albedo, Role role) {
  Material material;
  material.name = name;
  material.albedo = albedo;
  addPart(scene, mesh, material, role);
}

void addPart(Scene& scene, const Mesh& mesh, const Material& material, Role role) {
  Part part;
  part.name = material.name;
  part.firstTriangle = static_cast<uint32_t>(scene.mesh.triangles.size());
  part.triangleCount = static_cast<uint32_t>(mesh.triangles.size());
  part.material = static_cast<uint32_t>(scene.materials.size());
  part.receiverOnly = role == Role::ReceiverOnly;
  append(scene.mesh, mesh);
  scene.parts.push_back(std::move(part));
  scene.materials.push_back(material);
}

void addGround(Scene& scene, double size, glm::dvec3 centre) {
  addPart(scene, "ground", planeGrid(centre, size, size, kGroundCells), kGroundAlbedo, Role::ReceiverOnly);
}

AreaLight lightTowards(glm::dvec3 centre, glm::dvec3 target, glm::dvec2 size) {
  AreaLight light;
  const glm::dvec3 direction = glm::normalize(target - centre);
  light.centre = centre;
  light.axisX = perpendicular(direction);
  light.axisY = glm::cross(direction, light.axisX);
  light.size = size;
  return light;
}

Camera orbitCamera(glm::dvec3 target, double distance, double azimuthDeg, double elevationDeg,
                   double verticalFovDeg) {
  const double azimuth = glm::radians(azimuthDeg), elevation = glm::radians(elevationDeg);
  const glm::dvec3 back(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                        std::cos(azimuth) * std::cos(elevation));
  return {target + distance * back, target, {0.0, 1.0, 0.0}, verticalFovDeg};
}

void setStillCamera(Scene& scene, const Camera& camera) { scene.camera.keys = {{0.0, camera}}; }

void frameStanding(Scene& scene, double height, double reach) {
  const double extent = std::max(height, reach);
  const glm::dvec3 middle(0.0, 0.45 * height, 0.0);
  scene.lights = {
      lightTowards(middle + extent * glm::dvec3(-1.7, 3.0, 1.2), middle, glm::dvec2(0.2 * height))};
  setStillCamera(scene, orbitCamera({0.25 * extent, 0.3 * height, -0.1 * extent}, 3.4 * extent, 8.0, 40.0));
}

}  // namespace limen::scene
