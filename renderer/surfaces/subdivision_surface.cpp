// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/subdivision_surface.h"

#include "experiments/base/error.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace limen::surfaces {

glm::dmat4 Joint::at(double timeS) const {
  const double angle = amplitudeRad * std::sin(2.0 * M_PI * timeS / periodS + phaseRad);
  glm::dmat4 out = glm::translate(glm::dmat4(1.0), pivot);
  out = glm::rotate(out, angle, axis);
  return glm::translate(out, -pivot);
}

std::vector<glm::dvec3> skinned(const SubdivisionSurface& surface, double timeS) {
  std::vector<glm::dvec3> out = surface.cage.points;
  for (size_t v = 0; v < surface.bindings.size(); ++v) {
    const JointBinding& binding = surface.bindings[v];
    if (binding.weight == 0.0F) continue;
    const glm::dvec3 moved(surface.joints[binding.joint].at(timeS) * glm::dvec4(out[v], 1.0));
    out[v] = glm::mix(out[v], moved, double(binding.weight));
  }
  return out;
}

PolygonMesh attributeMesh(const PolygonMesh& cage, const CornerAttributes& attributes) {
  PolygonMesh out;
  out.points = attributes.values;
  out.faces = attributes.faces;
  const auto refuse = [](const std::string& what) {
    throw Error(what, "", "give each corner of the control mesh's faces one value");
  };
  if (out.faces.size() != cage.faces.size())
    refuse("attributes have " + std::to_string(out.faces.size()) + " faces of " +
           std::to_string(cage.faces.size()));
  for (size_t f = 0; f < out.faces.size(); ++f) {
    const std::vector<uint32_t>&of = out.faces[f], &face = cage.faces[f];
    if (of.size() != face.size()) refuse("attributes of face " + std::to_string(f) + " have other corners");
    for (size_t i = 0; i < of.size(); ++i) {
      const size_t next = (i + 1) % of.size();
      const auto sharp = cage.sharpness.find(edgeKey(face[i], face[next]));
      if (sharp != cage.sharpness.end()) out.sharpness[edgeKey(of[i], of[next])] = sharp->second;
    }
  }
  return out;
}

}  // namespace limen::surfaces
