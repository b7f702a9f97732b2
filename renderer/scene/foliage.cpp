// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <vector>

#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

/// Tree of straight twigs: each carries some thinner ones in its outer part, turned away from it.
class Tree {
 public:
  explicit Tree(int64_t seed) : random_(seed) {}

  void grow(glm::dvec3 base, glm::dvec3 direction, double length, double radius, int depth) {
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

  /// A pointed leaf of two triangles, folded along its middle, somewhere on an outermost twig.
  void addLeaf(double size) {
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

  const Mesh& wood() const { return wood_; }
  const Mesh& leaves() const { return leaves_; }

 private:
  struct Twig {
    glm::dvec3 base, tip;
  };
  Random random_;
  Mesh wood_, leaves_;
  std::vector<Twig> twigs_;
};

Scene buildFoliage(const ParameterValues& values) {
  Tree tree(values.integer("seed"));
  tree.grow(glm::dvec3(0.0), {0.0, 1.0, 0.0}, 0.75, 0.03, 3);
  for (int64_t i = 0; i < values.integer("leaves"); ++i) tree.addLeaf(values.real("leaf_size"));
  Scene scene;
  addGround(scene, 12.0);
  addPart(scene, "wood", tree.wood(), {0.35F, 0.25F, 0.17F});
  addPart(scene, "leaves", tree.leaves(), {0.2F, 0.42F, 0.12F});
  frameStanding(scene, 1.4, 0.8);
  return scene;
}

const Registered<SceneInfo> kRegistered{SceneInfo{
    .name = "foliage",
    .version = 1,
    .summary = "Small tree with thousands of leaves as plain triangles: huge counts of tiny occluders",
    .source = "stand-in for Schwarz 2009, Fig. 5.3",
    .parameters = {integerParameter("leaves", 4000, 0, 100000, "leaves",
                                    "Number of leaves, two triangles each"),
                   realParameter("leaf_size", 0.06, 0.005, 0.3, "m",
                                 "Mean length of a leaf; the tree is about 1.3 m"),
                   integerParameter("seed", 1, 0, 1000000, "", "Seed of the tree and its leaves")},
    .build = buildFoliage}};

}  // namespace
}  // namespace limen::scene
