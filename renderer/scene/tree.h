// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "renderer/scene/shapes.h"

namespace limen::scene {

/// Tree of straight twigs: each carries some thinner ones in its outer part, turned away from it.
class Tree {
 public:
  explicit Tree(int64_t seed) : random_(seed) {}

  /// A twig and everything it carries: 6 twigs per level over `depth` levels, each half as thick as its
  /// parent. `direction` is a unit vector.
  void grow(glm::dvec3 base, glm::dvec3 direction, double length, double radius, int depth);

  /// A pointed leaf of two triangles, folded along its middle, somewhere on an outermost twig.
  void addLeaf(double size);

  const Mesh& wood() const { return wood_; }  ///< closed pieces
  const Mesh& leaves() const { return leaves_; }

 private:
  struct Twig {
    glm::dvec3 base, tip;
  };
  Random random_;
  Mesh wood_, leaves_;
  std::vector<Twig> twigs_;
};

}  // namespace limen::scene
