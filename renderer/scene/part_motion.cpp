// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/part_motion.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <stdexcept>

#include "renderer/scene/scene.h"

namespace limen::scene {

glm::dmat4 PartMotion::at(double timeS) const {
  const double t = startS + timeS, turns = t / periodS;
  const glm::dvec3 offset = travel * std::sin(2.0 * std::numbers::pi * (turns - std::floor(turns)));
  const glm::dmat4 back = glm::translate(glm::dmat4(1.0), offset + pivot);
  const double turned = std::fmod(turnDegS * t, 360.0);
  if (turned == 0.0) return glm::translate(glm::dmat4(1.0), offset);
  return glm::translate(glm::rotate(back, glm::radians(turned), axis), -pivot);
}

std::vector<uint32_t> motionsOfVertices(const Scene& scene) {
  std::vector<uint32_t> ofParts(scene.parts.size(), 0);
  for (size_t i = 0; i < scene.motions.size(); ++i) {
    const uint32_t part = scene.motions[i].part;
    if (scene.materials[scene.parts[part].material].pattern.kind != Pattern::Kind::None)
      throw std::logic_error("a part with a solid texture cannot move: " + scene.parts[part].name);
    ofParts[part] = static_cast<uint32_t>(i + 1);
  }
  constexpr uint32_t kNone = 0xffffffffU;
  std::vector<uint32_t> out(scene.mesh.positions.size(), kNone);
  for (size_t i = 0; i < scene.parts.size(); ++i) {
    const Part& part = scene.parts[i];
    for (uint32_t t = part.firstTriangle; t < part.firstTriangle + part.triangleCount; ++t)
      for (int corner = 0; corner < 3; ++corner) {
        uint32_t& own = out[scene.mesh.triangles[t][corner]];
        if (own != kNone && own != ofParts[i])
          throw std::logic_error("a moving part shares vertices with another: " + part.name);
        own = ofParts[i];
      }
  }
  for (uint32_t& own : out)
    if (own == kNone) own = 0;
  return out;
}

Scene movedTo(const Scene& scene, double timeS) {
  Scene out = scene;
  out.motions.clear();
  if (scene.motions.empty()) return out;
  std::vector<glm::dmat4> motions;
  for (const PartMotion& motion : scene.motions) motions.push_back(motion.at(timeS));
  const std::vector<uint32_t> motionOf = motionsOfVertices(scene);
  for (size_t i = 0; i < motionOf.size(); ++i) {
    if (motionOf[i] == 0) continue;
    const glm::dmat4& motion = motions[motionOf[i] - 1];
    out.mesh.positions[i] = glm::dvec3(motion * glm::dvec4(out.mesh.positions[i], 1.0));
    if (!out.mesh.normals.empty())
      out.mesh.normals[i] = glm::vec3(glm::dmat3(motion) * glm::dvec3(out.mesh.normals[i]));
  }
  return out;
}

}  // namespace limen::scene
