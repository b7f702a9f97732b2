// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

constexpr double kGroundSize = 11.0;
constexpr int kTexturedCells = 32;

/// The ground between two x. Grids that meet at an x have bit for bit the same vertices there.
Mesh groundBetween(double low, double high) {
  Mesh mesh = planeGrid(glm::dvec3(0.0), 1.0, kGroundSize, kTexturedCells);
  for (glm::dvec3& position : mesh.positions) position.x = glm::mix(low, high, position.x + 0.5);
  return mesh;
}

Pattern patternNamed(const ParameterValues& values) {
  const std::string& texture = values.text("texture");
  Pattern pattern;
  pattern.kind = texture == "none"      ? Pattern::Kind::None
                 : texture == "checker" ? Pattern::Kind::Checker
                                        : Pattern::Kind::ValueNoise;
  pattern.size = values.real("texture_size");
  pattern.contrast = values.real("texture_contrast");
  // Off the ground: a checker's cubes must not end in the very plane that is seen.
  pattern.origin = {0.0, -0.5 * pattern.size, 0.0};
  return pattern;
}

/// A rail along x throws the same penumbrae on the plain and on the textured part of the ground, so that what
/// the texture masks is all that differs.
Scene buildTexturedGround(const ParameterValues& values) {
  const double half = 0.5 * kGroundSize, border = half - kGroundSize * values.real("textured_share");
  Scene scene;
  const glm::vec3 albedo(0.5F, 0.5F, 0.48F);
  if (border > -half) addPart(scene, "ground", groundBetween(-half, border), albedo, Role::ReceiverOnly);
  if (border < half) {
    addPart(scene, "textured_ground", groundBetween(border, half), albedo, Role::ReceiverOnly);
    scene.materials.back().pattern = patternNamed(values);
  }
  Mesh rails;
  for (int i = 0; i < 4; ++i) {
    const double y = 0.3 + 0.25 * i;
    append(rails, box({-1.7, y, -0.72}, {1.7, y + 0.05, -0.68}));
  }
  for (const double x : {-1.5, -0.5, 0.5, 1.5})
    append(rails, box({x - 0.03, 0.0, -0.76}, {x + 0.03, 1.2, -0.72}));
  addPart(scene, "rails", rails, {0.6F, 0.45F, 0.3F});
  Mesh balls;
  for (const double x : {-1.0, 1.0}) append(balls, sphere({x, 0.55, 0.35}, 0.22, 16));
  addPart(scene, "balls", balls, {0.65F, 0.62F, 0.6F});
  scene.lights = {lightTowards({0.0, 4.2, -2.6}, {0.0, 0.2, 0.2}, {0.5, 0.5})};
  setStillCamera(scene, orbitCamera({0.0, 0.1, 0.4}, 5.2, 0.0, 42.0));
  return scene;
}

const Registered<SceneInfo> kTexturedGroundRegistered{SceneInfo{
    .name = "textured_ground",
    .version = 1,
    .summary = "The same penumbrae on plain and on highly textured ground: what texture masks",
    .source = "stand-in for Schwarz 2009, Fig. 5.4",
    .parameters = {choiceParameter("texture", "noise", {"none", "checker", "noise"},
                                   "Solid texture of the textured ground"),
                   realParameter("texture_size", 0.06, 0.005, 2.0, "m",
                                 "Edge of a checker's cubes, or pitch of the noise's coarsest lattice"),
                   realParameter("texture_contrast", 0.9, 0.0, 1.0, "", "Contrast of the texture"),
                   realParameter("textured_share", 0.5, 0.0, 1.0, "",
                                 "Share of the ground that is textured, from its right side (+x) on")},
    .build = buildTexturedGround}};

}  // namespace
}  // namespace limen::scene
