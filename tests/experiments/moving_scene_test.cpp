// SPDX-License-Identifier: BSD-3-Clause
// Every registered technique with a scene whose parts move: it is refused with an error, or shows the moved
// state; none shows what was.
#include <gtest/gtest.h>

#include <set>

#include "experiments/base/error.h"
#include "experiments/scene_rendering.h"
#include "renderer/gl/context.h"
#include "renderer/scene/part_motion.h"
#include "renderer/techniques/technique.h"

namespace limen::experiments {
namespace {

double meanDifference(const Image& a, const Image& b) {
  double sum = 0.0;
  for (size_t i = 0; i < a.data.size(); ++i) sum += std::abs(double(a.data[i]) - b.data[i]);
  return sum / double(a.data.size());
}

/// The scene with the box of another one, by vertices that no triangle has: grids are fitted to wherever
/// parts move.
scene::Scene withBoxOf(scene::Scene scene, const scene::Scene& other) {
  const scene::Bounds box = other.bounds();
  for (const glm::dvec3 corner : {box.low, box.high}) {
    scene.mesh.positions.push_back(corner);
    if (!scene.mesh.normals.empty()) scene.mesh.normals.emplace_back(0.0F, 1.0F, 0.0F);
  }
  return scene;
}

TEST(MovingScene, EveryTechniqueRefusesItOrShowsTheMovedState) {
  const std::unique_ptr<gl::Context> context = gl::createHeadlessContext();
  const auto build = [](double timeS) {
    return scene::buildScene(
        "mirrors/ellipsoid",
        ParameterValues(
            scene::SceneRegistry::instance().get("mirrors/ellipsoid").allParameters(),
            {{"tessellation", int64_t{8}}, {"motion", std::string("moving")}, {"motion.time_s", timeS}}));
  };
  const frame::SceneOnGpu moving(build(1.3)), baked(withBoxOf(scene::movedTo(build(1.3), 0.0), moving.scene)),
      before(withBoxOf(scene::movedTo(build(0.0), 0.0), moving.scene));
  std::set<std::string> shown, refused;
  for (const auto& [name, info] : techniques::TechniqueRegistry::instance().all()) {
    const auto lacks = [&](const std::string& trait) { return !baked.scene.traits().count(trait); };
    if (std::any_of(info.needs.begin(), info.needs.end(), lacks)) continue;
    Image found;
    try {
      const Configuration of{name, info.version, ParameterValues(info.parameters, {})};
      found = renderOnce(*context, moving, {64, 48}, of);
      const Image expected = renderOnce(*context, baked, {64, 48}, of),
                  old = renderOnce(*context, before, {64, 48}, of);
      const double change = meanDifference(expected, old);
      EXPECT_GT(change, 0.0) << name;
      // Of pixels at edges, by rounding; points are those of a tree that is built of parts at rest, and
      // other ones stand for parts that moved. What a scene needs is another technique, with errors of its
      // own, where parts move.
      // Fields are made in an object's own axes: of one that has turned, other stored rays tell of the same
      // ray.
      const double most = name == "many_lods/points" || name == "reflections/scene_needs" ? 0.5
                          : name.starts_with("visibility_fields/")                        ? 0.2
                                                                                          : 0.05;
      EXPECT_LT(meanDifference(found, expected), most * change) << name;
      shown.insert(name);
    } catch (const Error&) {
      refused.insert(name);
    }
  }
  for (const char* name :
       {"reflections/ray_hierarchy", "reflections/vertex_reflection", "reflections/environment_map",
        "reflections/screen_space", "reflections/planar_mirror", "reflections/reference"})
    EXPECT_TRUE(shown.count(name)) << name;
  // What keeps a tree or shadow maps, and what knows nothing of motion.
  for (const char* name : {"reflections/ray_traced", "soft_shadows/hard"})
    EXPECT_TRUE(refused.count(name)) << name;
}

}  // namespace
}  // namespace limen::experiments
