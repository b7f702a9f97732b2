// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/stage.h"
#include "renderer/scene/tree.h"

namespace limen::scene {
namespace {

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

const Registered<SceneInfo> kFoliageRegistered{SceneInfo{
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
