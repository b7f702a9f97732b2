// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace limen::techniques {

/// Solid angles [sr] of a picture's pixels as its eye sees them (Roger 2008, section 5.2): one quadrant is
/// stored, the others follow by symmetry.
class PixelSolidAngles {
 public:
  /// `tanHalfFov`: tangent of half the vertical field of view, > 0; pixels are square.
  PixelSolidAngles(glm::ivec2 sizePx, double tanHalfFov);
  double at(glm::ivec2 pixel) const;
  size_t stored() const { return quadrant_.size(); }

 private:
  glm::ivec2 sizePx_, quadrantPx_;
  std::vector<double> quadrant_;
};

/// Half-angle [rad] of the circular cone of a solid angle [sr], 0 to 4 pi (reconstructed: 2 pi (1 - cos)
/// solved for it).
double coneHalfAngle(double solidAngleSr);

}  // namespace limen::techniques
