// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

namespace limen::techniques {

/// A lobe known by its flux 1 and the mean of its directions, `focus` times the unit vector `axis`: linear in
/// the cosine to the axis, cut off at 0, as flat or narrow as the mean demands. That of a diffuse surface,
/// the clamped cosine, is one (focus 2/3), and so are the sphere (0) and a beam (1).
///
/// What of it leaves a cell through each face: a direction w, which fills the cell evenly, by its share
/// |w_axis| / (|w_x| + |w_y| + |w_z|), as finite volumes have it. Faces: 2 * axis, + 1 on the low side.
struct FaceShares {
  std::array<double, 6> flux{};        ///< sums to 1
  std::array<glm::dvec3, 6> vector{};  ///< sums to focus * axis
};
FaceShares faceShares(double focus, glm::dvec3 axis);

/// The same as texels of a volume of kShareSide x kShareSide x (kShareLevels * 6), share and vector, of axes
/// with components >= 0; transport.glsl reads it. Along x: x / (x + y) of the axis, along y: z / (x + y + z),
/// from 0 to 1 at the middles of the first and last texel; along z the focuses, for one face after another.
/// Shares are whole multiples of 1 / 32767 and still sum to 1, so that 16 bits hold them exactly and create
/// no light.
std::vector<float> shareTable();

}  // namespace limen::techniques
