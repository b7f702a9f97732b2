// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/patch_motion.h"

#include <cmath>

#include "renderer/surfaces/patch_set.h"

namespace limen::surfaces {

glm::dvec2 PatchMotion::waveAt(double timeS) const {
  if (!moves()) return glm::dvec2(0.0);
  const double turns = timeS / periodS, angle = 2.0 * M_PI * (turns - std::floor(turns));
  return {std::sin(angle), std::cos(angle)};
}

PatchSet movedTo(PatchSet set, double timeS) {
  if (!set.motion.moves()) return set;
  const glm::dvec2 wave = set.motion.waveAt(timeS);
  for (size_t i = 0; i < set.points.size(); ++i) {
    glm::dvec4& p = set.points[i];
    p += glm::dvec4(p.w * (wave.x * set.motion.sine[i] + wave.y * set.motion.cosine[i]), 0.0);
  }
  set.motion = {};
  return set;
}

}  // namespace limen::surfaces
