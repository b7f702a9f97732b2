// SPDX-License-Identifier: BSD-3-Clause
#include "tests/renderer/scene/scene_fixtures.h"
#include "tests/renderer/techniques/reflections/reflection_fixture.h"

namespace limen::techniques {
namespace {

class MirrorScenes : public ReflectionTest {};

/// Every scene with mirrors, at two bounces and with shadows: the tracer has what the reference has, but for
/// pixels whose centre or whose ray is within rounding of an edge. Curved mirrors magnify rounding at each
/// bounce, coarse bumps and vessels without limit where they are hollow: 1 % of the pixels may differ.
/// Beside a vertex without a normal the mean of the others is short, and its direction magnifies rounding as
/// well.
TEST_F(MirrorScenes, AreTracedAsTheReferenceHasThem) {
  size_t seen = 0;
  for (const auto& [name, info] : scene::SceneRegistry::instance().all()) {
    if (name.rfind("mirrors/", 0) != 0 || !scene::fixtures::installed(name)) continue;
    const scene::Scene scene = scene::fixtures::build(name);
    EXPECT_TRUE(scene.traits().count("mirrors")) << name;
    const Given given = {{"bounces", int64_t{2}}, {"shadows", int64_t{1}}};
    const Image truth = render(scene, "reflections/reference", given, {96, 72}).product;
    const Image found = render(scene, "reflections/ray_traced", given, {96, 72}).product;
    const double tolerance = name == "mirrors/damaged" ? 0.02 : 4e-3;
    EXPECT_LE(differing(found, truth, tolerance).count, size_t(0.01 * 96 * 72)) << name;
    ++seen;
  }
  EXPECT_GE(seen, 11U);
}

/// The sizes that the scenes' summaries state.
TEST_F(MirrorScenes, AreAsLargeAsTheySay) {
  const auto kitchen = double(makeScene("mirrors/kitchen").mesh.triangles.size());
  EXPECT_NEAR(kitchen, 83e3, 1e3);
  EXPECT_GT(makeScene("mirrors/herd").mesh.triangles.size(), 1000000U);
  const scene::Scene box = makeScene("mirrors/box");
  const auto figure = std::find_if(box.parts.begin(), box.parts.end(),
                                   [](const scene::Part& part) { return part.name == "statue"; });
  ASSERT_NE(figure, box.parts.end());
  EXPECT_EQ(figure->triangleCount, 28800U);
}

}  // namespace
}  // namespace limen::techniques
