// SPDX-License-Identifier: BSD-3-Clause
// A mirror that is hard to trace from: triangles without area, slivers, and vertices without a normal.
#include "renderer/scene/mirrors/mirror_parts.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

/// A ball every seventh triangle of which is doubled by one without area along its edge, every eleventh by a
/// sliver; every fifth vertex has no normal, and so leaves its part of the triangles around to the others.
Scene buildDamagedMirror(const NoSettings&) {
  Scene scene;
  addCheckeredGround(scene, 6.0, 0.25);
  Mesh ball = ellipsoid({0.0, 0.5, 0.0}, glm::dvec3(0.5), 24);
  const size_t count = ball.triangles.size();
  for (size_t i = 0; i < count; ++i) {
    const glm::uvec3 of = ball.triangles[i];
    if (i % 7 == 0) ball.triangles.emplace_back(of.x, of.y, of.x);
    if (i % 11 == 0) {
      const glm::dvec3 a = ball.positions[of.x], b = ball.positions[of.y], c = ball.positions[of.z];
      const auto middle = static_cast<uint32_t>(ball.positions.size());
      ball.positions.push_back(0.5 * (a + b) + 1e-6 * (c - a));
      ball.normals.push_back(ball.normals[of.x]);
      ball.triangles.emplace_back(of.x, of.y, middle);
    }
  }
  for (size_t i = 0; i < ball.normals.size(); i += 5) ball.normals[i] = glm::vec3(0.0F);
  addPart(scene, ball, mirrorMaterial(0.8));
  // A box that stands in the floor's plane and touches the ball, and a mirror that lies in the plane of its
  // side.
  addPart(scene, "box", box({0.5, 0.0, -0.2}, {0.8, 0.7, 0.2}), {0.7F, 0.25F, 0.2F});
  addPart(scene, card({0.5, 0.35, 0.6}, {0.0, 0.0, -0.3}, {0.0, 0.35, 0.0}), mirrorMaterial(0.6));
  frameStanding(scene, 1.0, 1.0);
  return scene;
}

const RegisteredScene<NoSettings> kDamagedMirror{
    {.name = "mirrors/damaged",
     .version = 1,
     .summary = "Mirroring ball with triangles without area, slivers and vertices without a normal, and "
                "mirrors in contact",
     .source = "bench"},
    buildDamagedMirror};

}  // namespace
}  // namespace limen::scene
