// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/subdivision_surface.h"

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

}  // namespace limen::surfaces
