// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace limen::surfaces {

struct PatchSet;

/// Control points that move to and fro: at time t each lies beside its place by sin(2 pi t / period) times
/// one vector and cos(2 pi t / period) times another; world units. Weights stay.
struct PatchMotion {
  double periodS = 0.0;                  ///< 0: all points rest
  std::vector<glm::dvec3> sine, cosine;  ///< one for each of PatchSet::points, if they move
  bool moves() const { return periodS > 0.0; }
  /// Factors of `sine` and `cosine` at a time.
  glm::dvec2 waveAt(double timeS) const;
};

/// The set as it is at a time, at rest.
PatchSet movedTo(PatchSet set, double timeS);

}  // namespace limen::surfaces
