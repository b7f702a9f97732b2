// SPDX-License-Identifier: BSD-3-Clause
// Pictures of scenes whose parts move, against those of a scene at rest that was built as the parts are then.
#include "renderer/scene/part_motion.h"
#include "tests/renderer/techniques/reflections/reflection_fixture.h"

namespace limen::techniques {
namespace {

class MovingParts : public ReflectionTest {
 protected:
  /// Pictures at the times, by one technique in one frame.
  static std::vector<Image> path(const scene::Scene& scene, const std::string& technique, const Given& given,
                                 const std::vector<double>& timesS) {
    const TechniqueInfo& info = TechniqueRegistry::instance().get(technique);
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, kSize);
    const auto made = info.make(ParameterValues(info.parameters, given));
    made->prepare(frame);
    std::vector<Image> out;
    for (const double timeS : timesS) {
      frame.setTime(timeS);
      frame.begin();
      made->render(frame);
      frame.end();
      out.push_back(made->product().read());
    }
    return out;
  }

  /// Vertices that the GPU moves are off by a few 2^-24 of the scene's size, 6 units: 1e-6, and normals by as
  /// much. A pixel sees the difference where its ray or its mirrored ray passes that close to an edge: of
  /// 3000 px of edges, at 40 px a unit, 3000 * 40 * 1e-6 < 1; the bumps of mirrors multiply it by some 10.
  /// Elsewhere shading changes by less than 1 a unit, and a mirrored ray by 20 times the offset: 2e-5.
  void expectMovedState(const scene::Scene& scene, const std::string& technique, const Given& given) {
    const std::vector<double> times = {0.0, 0.4, 1.3};
    const std::vector<Image> found = path(scene, technique, given, times);
    for (size_t i = 0; i < times.size(); ++i) {
      const scene::Scene then = scene::movedTo(scene, times[i]);
      const Image expected = path(then, technique, given, {times[i]})[0];
      const Differing result = differing(found[i], expected, 1e-3);
      EXPECT_LE(result.count, 12U) << technique << " at " << times[i];
      // Stale pictures are far off.
      if (i == 0) continue;
      EXPECT_GT(differing(found[i], found[0], 0.02).count, 200U) << technique << " at " << times[i];
    }
  }

  static constexpr glm::ivec2 kSize{96, 72};
};

TEST_F(MovingParts, TechniquesThatFollowThemGiveTheMovedState) {
  const Given moving = {{"motion", std::string("moving")}, {"motion.time_s", 0.2}};
  Given ellipsoid = moving;
  ellipsoid["tessellation"] = int64_t{16};
  const scene::Scene scene = makeScene("mirrors/ellipsoid", ellipsoid);
  for (const char* tree : {"rebuilt", "refitted"})
    expectMovedState(scene, "reflections/ray_traced",
                     {{"tree", std::string(tree)}, {"bounces", int64_t{2}}, {"shadows", int64_t{1}}});
  expectMovedState(scene, "reflections/ray_hierarchy", {{"bounces", int64_t{2}}, {"shadows", int64_t{1}}});
  expectMovedState(scene, "reflections/ray_hierarchy", {{"primary", std::string("traced")}});
  expectMovedState(scene, "reflections/vertex_reflection", {});
  expectMovedState(scene, "reflections/vertex_reflection",
                   {{"tessellation", std::string("even")},
                    {"tessellation.segments", int64_t{3}},
                    {"invalid", std::string("drop")}});
  // A finite map's radius is a share of the scene's diagonal, which here covers wherever parts move.
  for (const char* lookup : {"infinite", "depth"})
    expectMovedState(scene, "reflections/environment_map", {{"lookup", std::string(lookup)}});
  expectMovedState(scene, "reflections/screen_space", {});
  expectMovedState(scene, "reflections/reference", {{"shading.shadow", true}});
}

/// Mirrors among what moves, smooth normals that turn, many parts.
TEST_F(MovingParts, MirrorsThatMoveToo) {
  const scene::Scene scene =
      makeScene("mirrors/kitchen", {{"tessellation", int64_t{6}}, {"motion", std::string("moving")}});
  ASSERT_TRUE(scene.traits().count("moving_parts"));
  for (const char* tree : {"rebuilt", "refitted"})
    expectMovedState(scene, "reflections/ray_traced", {{"tree", std::string(tree)}, {"bounces", int64_t{2}}});
  expectMovedState(scene, "reflections/ray_hierarchy", {{"bounces", int64_t{2}}});
}

/// The same moved state by float on the GPU and by double on the CPU, from the motion alone; as where nothing
/// moves (AgreesWithTheReferencePixelByPixel), but for a coarser ellipsoid with longer ways.
TEST_F(MovingParts, RaysAgreeWithTheReference) {
  const scene::Scene scene = makeScene(
      "mirrors/bunny", {{"detail", 0.02}, {"motion", std::string("moving")}, {"motion.time_s", 0.6}});
  const Image truth = path(scene, "reflections/reference", {}, {0.5})[0];
  for (const char* tree : {"rebuilt", "refitted"})
    EXPECT_LE(differing(path(scene, "reflections/ray_traced", {{"tree", std::string(tree)}}, {0.0, 0.5})[1],
                        truth, 1e-3)
                  .count,
              40U);
  EXPECT_LE(differing(path(scene, "reflections/ray_hierarchy", {}, {0.0, 0.5})[1], truth, 1e-3).count, 40U);
}

/// Figures that share the 32 parts which may move; their ground is a planar mirror at rest.
TEST_F(MovingParts, AHerdWalks) {
  const Given given = {
      {"figures", int64_t{70}}, {"tessellation", int64_t{1}}, {"motion", std::string("moving")}};
  const scene::Scene scene = makeScene("mirrors/herd", given);
  EXPECT_EQ(scene.motions.size(), 24U) << "three figures a part";
  for (const char* tree : {"rebuilt", "refitted"})
    expectMovedState(scene, "reflections/ray_traced", {{"tree", std::string(tree)}});
  expectMovedState(scene, "reflections/ray_hierarchy", {});
  expectMovedState(scene, "reflections/planar_mirror", {});
}

TEST_F(MovingParts, AHerdAtTimeZeroStandsWhereItRests) {
  const Given few = {{"figures", int64_t{20}}, {"tessellation", int64_t{1}}};
  Given moving = few;
  moving["motion"] = std::string("moving");
  const scene::Scene rests = makeScene("mirrors/herd", few),
                     walks = scene::movedTo(makeScene("mirrors/herd", moving), 0.0);
  ASSERT_EQ(rests.mesh.positions.size(), walks.mesh.positions.size());
  for (size_t i = 0; i < rests.mesh.positions.size(); ++i)
    ASSERT_LT(glm::length(rests.mesh.positions[i] - walks.mesh.positions[i]), 1e-12) << i;
}

TEST_F(MovingParts, WhatIsMadeOnceIsRefused) {
  const scene::Scene scene =
      makeScene("mirrors/ellipsoid", {{"tessellation", int64_t{8}}, {"motion", std::string("moving")}});
  EXPECT_THROW(render(scene, "reflections/ray_traced", {}, kSize), Error) << "a kept tree";
  EXPECT_THROW(render(scene, "reflections/ray_traced",
                      {{"tree", std::string("rebuilt")}, {"shading.shadow", true}}, kSize),
               Error)
      << "a shadow map";
  EXPECT_THROW(
      render(scene, "reflections/vertex_reflection", {{"surroundings", std::string("environment")}}, kSize),
      Error);
  const scene::Scene kitchen =
      makeScene("mirrors/kitchen", {{"tessellation", int64_t{6}}, {"motion", std::string("moving")}});
  EXPECT_THROW(render(kitchen, "reflections/vertex_reflection", {}, kSize), Error) << "a mirror that moves";
  EXPECT_THROW(render(kitchen, "reflections/environment_map", {}, kSize), Error) << "a mirror that moves";
  EXPECT_THROW(render(kitchen, "reflections/planar_mirror", {}, kSize), Error) << "a mirror that moves";
}

}  // namespace
}  // namespace limen::techniques
