// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/stage.h"
#include "renderer/scene/tree.h"

namespace limen::scene {
namespace {

struct FoliageSettings {
  int64_t leaves = 4000;
  double leafSize = 0.06;
  int64_t seed = 1;
  static const SettingsTable<FoliageSettings>& table() {
    using S = FoliageSettings;
    static const SettingsTable<S> kTable = {
        {&S::leaves, "leaves", {0, 100000}, "leaves", "Number of leaves, two triangles each"},
        {&S::leafSize, "leaf_size", {0.005, 0.3}, "m", "Mean length of a leaf; the tree is about 1.3 m"},
        {&S::seed, "seed", {0, 1000000}, "", "Seed of the tree and its leaves"}};
    return kTable;
  }
};

Scene buildFoliage(const FoliageSettings& settings) {
  Tree tree(settings.seed);
  tree.grow(glm::dvec3(0.0), {0.0, 1.0, 0.0}, 0.75, 0.03, 3);
  for (int64_t i = 0; i < settings.leaves; ++i) tree.addLeaf(settings.leafSize);
  Scene scene;
  addGround(scene, 12.0);
  addPart(scene, "wood", tree.wood(), {0.35F, 0.25F, 0.17F});
  addPart(scene, "leaves", tree.leaves(), {0.2F, 0.42F, 0.12F});
  frameStanding(scene, 1.4, 0.8);
  return scene;
}

const RegisteredScene<FoliageSettings> kFoliageRegistered{
    {.name = "foliage",
     .version = 1,
     .summary = "Small tree with thousands of leaves as plain triangles: huge counts of tiny occluders",
     .source = "stand-in for Schwarz 2009, Fig. 5.3"},
    buildFoliage};

}  // namespace
}  // namespace limen::scene
