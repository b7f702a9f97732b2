// SPDX-License-Identifier: BSD-3-Clause
// Cornell box, from the measured data published by the Cornell University Program of Computer Graphics
// (https://www.graphics.cornell.edu/online/box/data.html), in metres. Reflectances are the usual linear RGB
// values for its measured spectra.
#include <cmath>
#include <numbers>

#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

constexpr glm::vec3 kWhite{0.725F, 0.71F, 0.68F}, kRed{0.63F, 0.065F, 0.05F}, kGreen{0.14F, 0.45F, 0.091F};
constexpr double kMillimetre = 0.001;
constexpr int kWallCells = 8;

/// Bilinear grid over a quadrilateral given counter-clockwise as seen from inside the box.
Mesh wall(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c, glm::dvec3 d) {
  Mesh mesh = cardGrid(glm::dvec3(0.0), {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, kWallCells);
  for (glm::dvec3& p : mesh.positions) {
    const double u = 0.5 * (p.x + 1.0), v = 0.5 * (p.y + 1.0);
    p = kMillimetre * glm::mix(glm::mix(a, b, u), glm::mix(d, c, u), v);
  }
  return mesh;
}

/// Prism on the floor; the published top corners run clockwise as seen from above in this frame (y up, x to
/// the left).
Mesh block(double height, glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 d) {
  const auto at = [](glm::dvec2 p, double y) { return kMillimetre * glm::dvec3(p.x, y, p.y); };
  return hexahedron({at(a, 0.0), at(b, 0.0), at(c, 0.0), at(d, 0.0), at(a, height), at(b, height),
                     at(c, height), at(d, height)});
}

Scene buildCornellBox(const NoSettings&) {
  using V = glm::dvec3;
  Scene scene;
  const auto addWall = [&](const char* name, V a, V b, V c, V d, glm::vec3 albedo) {
    addPart(scene, name, wall(a, b, c, d), albedo, Role::ReceiverOnly);
  };
  addWall("floor", V(552.8, 0.0, 0.0), V(0.0, 0.0, 0.0), V(0.0, 0.0, 559.2), V(549.6, 0.0, 559.2), kWhite);
  addWall("ceiling", V(556.0, 548.8, 0.0), V(556.0, 548.8, 559.2), V(0.0, 548.8, 559.2), V(0.0, 548.8, 0.0),
          kWhite);
  addWall("back", V(549.6, 0.0, 559.2), V(0.0, 0.0, 559.2), V(0.0, 548.8, 559.2), V(556.0, 548.8, 559.2),
          kWhite);
  addWall("right", V(0.0, 0.0, 559.2), V(0.0, 0.0, 0.0), V(0.0, 548.8, 0.0), V(0.0, 548.8, 559.2), kGreen);
  addWall("left", V(552.8, 0.0, 0.0), V(549.6, 0.0, 559.2), V(556.0, 548.8, 559.2), V(556.0, 548.8, 0.0),
          kRed);
  addPart(scene, "short_block", block(165.0, {130.0, 65.0}, {82.0, 225.0}, {240.0, 272.0}, {290.0, 114.0}),
          kWhite);
  addPart(scene, "tall_block", block(330.0, {423.0, 247.0}, {265.0, 296.0}, {314.0, 456.0}, {472.0, 406.0}),
          kWhite);
  // A tenth of a millimetre below the ceiling, which would otherwise lie in the light's plane.
  const glm::dvec3 centre(0.5 * (213.0 + 343.0), 548.7, 0.5 * (227.0 + 332.0));
  scene.lights = {lightTowards(kMillimetre * centre, kMillimetre * glm::dvec3(centre.x, 0.0, centre.z),
                               kMillimetre * glm::dvec2(343.0 - 213.0, 332.0 - 227.0))};
  // Published camera: focal length 0.035, film 0.025 x 0.025.
  const double fovDeg = glm::degrees(2.0 * std::atan(0.5 * 0.025 / 0.035));
  setStillCamera(scene, Camera{kMillimetre * V(278.0, 273.0, -800.0),
                               kMillimetre * V(278.0, 273.0, 0.0),
                               {0.0, 1.0, 0.0},
                               fovDeg});
  return scene;
}

const RegisteredScene<NoSettings> kCornellBoxRegistered{
    {.name = "cornell_box",
     .version = 1,
     .summary =
         "Cornell box: two blocks in a room under a ceiling light; one side is open, use a square image",
     .source = "Cornell University Program of Computer Graphics, measured Cornell box data"},
    buildCornellBox};

}  // namespace
}  // namespace limen::scene
