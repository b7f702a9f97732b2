// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

/// The light is wider than the box and straight above it: from the light's centre only the box's top is seen,
/// from its rim the sides shadow more. A single shadow map from the centre misses that, and where the box
/// hovers it misses the umbra below.
Scene buildBoxUnderLight(const ParameterValues& values) {
  constexpr double kHeightOfLight = 3.2;
  const double foot = values.real("clearance"), top = foot + values.real("box_height");
  if (top >= kHeightOfLight)
    throw Error("the box reaches up to " + shortestNumber(top) + " m, and the light is at " +
                    shortestNumber(kHeightOfLight) + " m",
                "box_under_light", "lower 'box_height' or 'clearance'");
  Scene scene;
  addGround(scene, 12.0);
  Mesh caster = box({-0.5, foot, -0.5}, {0.5, top, 0.5});
  if (!values.boolean("sides"))
    std::erase_if(caster.triangles, [&](const glm::uvec3& t) {
      return caster.positions[t.x].y != caster.positions[t.y].y ||
             caster.positions[t.x].y != caster.positions[t.z].y;
    });
  addPart(scene, "box", caster, {0.7F, 0.5F, 0.35F});
  scene.lights = {lightTowards({0.0, kHeightOfLight, 0.0}, glm::dvec3(0.0), {2.0, 2.0})};
  setStillCamera(scene, orbitCamera({0.0, 0.3, 0.0}, 5.2, 25.0, 40.0));
  return scene;
}

/// A small high box partly above a low wide one: their penumbrae meet on the ground and the upper one falls
/// on the lower.
Scene buildTwoBoxes(const ParameterValues& values) {
  const double gap = values.real("gap");
  Scene scene;
  addGround(scene, 9.0);
  addPart(scene, "low_box", box({-0.7, 0.0, -0.4}, {0.5, 0.4, 0.5}), {0.45F, 0.55F, 0.7F});
  addPart(scene, "high_box", box({-0.1, 0.4 + gap, -0.3}, {0.7, 0.6 + gap, 0.3}), {0.75F, 0.55F, 0.3F});
  frameStanding(scene, 1.0, 1.0);
  return scene;
}

/// The shadow is sharp at the foot and soft at its end.
Scene buildPole(const ParameterValues& values) {
  const double radius = values.real("radius");
  Scene scene;
  addGround(scene, 10.0);
  Mesh pole = frustum({0.0, 0.0, 0.0}, {0.0, 1.9, 0.0}, radius, 0.7 * radius, 24);
  append(pole, frustum({0.0, 1.88, 0.0}, {0.5, 1.96, 0.0}, 0.6 * radius, 0.6 * radius, 24));
  append(pole, box({0.42, 1.9, -0.07}, {0.72, 1.96, 0.07}));
  addPart(scene, "pole", pole, {0.4F, 0.4F, 0.42F});
  scene.lights = {lightTowards({-3.2, 4.2, 2.4}, {0.3, 0.6, 0.0}, {0.3, 0.3})};
  setStillCamera(scene, orbitCamera({0.6, 0.6, -0.3}, 4.6, 12.0, 44.0));
  return scene;
}

const Registered<SceneInfo> kBoxUnderLight{SceneInfo{
    .name = "box_under_light",
    .version = 1,
    .summary = "Box below a larger light: a shadow map from the centre sees only its top",
    .source = "Schwarz 2009, Fig. 4.3",
    .parameters =
        {realParameter("box_height", 1.0, 0.05, 2.0, "m", "Height of the box; the light is at 3.2 m"),
         realParameter("clearance", 0.0, 0.0, 2.0, "m", "Height of the box's underside above the ground"),
         booleanParameter("sides", true, "Without, two flat blockers are left: the top and the underside")},
    .build = buildBoxUnderLight}};

const Registered<SceneInfo> kTwoBoxes{SceneInfo{
    .name = "two_boxes",
    .version = 1,
    .summary = "A floating box above a standing one: fused penumbrae and a shadow on an occluder",
    .source = "bench",
    .parameters = {realParameter("gap", 0.3, 0.0, 0.6, "m", "Clear height between the boxes; 0: they touch")},
    .build = buildTwoBoxes}};

const Registered<SceneInfo> kPole{SceneInfo{
    .name = "pole",
    .version = 1,
    .summary = "Street lamp: one thin shadow from contact to far penumbra",
    .source = "Schwarz 2009, Fig. 3.2",
    .parameters = {realParameter("radius", 0.04, 0.002, 0.2, "m", "Radius of the pole at its foot")},
    .build = buildPole}};

}  // namespace
}  // namespace limen::scene
