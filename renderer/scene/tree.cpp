// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/tree.h"

#include <algorithm>

namespace limen::scene {

void Tree::grow(glm::dvec3 base, glm::dvec3 direction, double length, double radius, int depth) {
  const glm::dvec3 tip = base + length * direction;
  append(wood_, frustum(base, tip, radius, 0.55 * radius, depth > 1 ? 8 : 5));
  if (depth == 0) {
    twigs_.push_back({base, tip});
    return;
  }
  constexpr int kChildren = 6;
  for (int i = 0; i < kChildren; ++i) {
    const double along = 0.4 + 0.6 * (i + random_.uniform(0.0, 1.0)) / kChildren;
    // Light pulls twigs upwards a little.
    const glm::dvec3 turned = direction + 1.2 * random_.direction() + glm::dvec3(0.0, 0.25, 0.0);
    if (glm::dot(turned, turned) < 1e-6) continue;
    grow(glm::mix(base, tip, along), glm::normalize(turned), length * random_.uniform(0.5, 0.65),
         0.5 * radius, depth - 1);
  }
}

void Tree::addLeaf(double size) {
  const auto pick = static_cast<size_t>(random_.uniform(0.0, static_cast<double>(twigs_.size())));
  const Twig& twig = twigs_[std::min(pick, twigs_.size() - 1)];
  const glm::dvec3 stem = glm::mix(twig.base, twig.tip, random_.uniform(0.2, 1.0));
  const glm::dvec3 along = random_.direction(), side = perpendicular(along), up = glm::cross(along, side);
  const double length = size * random_.uniform(0.7, 1.3), width = 0.25 * length, fold = 0.3 * width;
  const auto first = static_cast<uint32_t>(leaves_.positions.size());
  leaves_.positions.push_back(stem);
  leaves_.positions.push_back(stem + 0.5 * length * along + width * side + fold * up);
  leaves_.positions.push_back(stem + length * along);
  leaves_.positions.push_back(stem + 0.5 * length * along - width * side + fold * up);
  leaves_.triangles.emplace_back(first, first + 1, first + 2);
  leaves_.triangles.emplace_back(first, first + 2, first + 3);
}

}  // namespace limen::scene
