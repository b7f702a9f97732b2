// SPDX-License-Identifier: BSD-3-Clause
// The model of Schwarz 2009 (Table 7.4) is not described beyond its 332 rational patches; this one has as
// many. Profiles are (distance from the axis, height) in units of the table's height, from below to above
// along the outside.
#include "renderer/scene/curved/tea_table.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "renderer/scene/curved/teapot.h"
#include "renderer/surfaces/neighbours.h"
#include "renderer/surfaces/patch_builder.h"
#include "renderer/surfaces/patch_convert.h"
#include "renderer/surfaces/quadrics.h"

namespace limen::scene {
namespace {

using surfaces::PatchSet;
using surfaces::Profile;
using surfaces::quarterArc;
using surfaces::segment;

PatchSet solid(std::initializer_list<Profile> bands) {
  PatchSet set;
  for (const Profile& band : bands) append(set, surfaces::revolved(band));
  return set;
}

Profile curve(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 d) {
  return surfaces::bezierProfile(std::array{a, b, c, d});
}

/// Cubic B-splines are no circles; half of a rational ring is: eight patches.
PatchSet handle(double radius, double tube) {
  const PatchSet ring = surfaces::torus(radius, tube);
  PatchSet half;
  // Quarters 0 and 3 of each band lie at x > 0.
  for (size_t p = 0; p < ring.patches.size(); ++p) {
    const surfaces::Patch& patch = ring.patches[p];
    const auto first = ring.points.begin() + patch.firstPoint;
    if (p % 4 == 0 || p % 4 == 3)
      addRectangle(half, patch.degreeU, patch.degreeV,
                   std::vector<glm::dvec4>(first, first + patch.points()));
  }
  // The ring's plane becomes vertical.
  return transformed(half, glm::rotate(glm::dmat4(1.0), glm::radians(90.0), glm::dvec3(1.0, 0.0, 0.0)));
}

/// 4 bands.
PatchSet tableTop() {
  return solid({segment({0, 0.95}, {0.8, 0.95}), quarterArc({0.8, 0.95}, {0.825, 0.95}, {0.825, 0.975}),
                quarterArc({0.825, 0.975}, {0.825, 1.0}, {0.8, 1.0}), segment({0.8, 1.0}, {0, 1.0})});
}
/// 2 bands.
PatchSet tableLeg() {
  return solid({curve({0.025, 0}, {0.05, 0.1}, {0.02, 0.4}, {0.035, 0.6}),
                curve({0.035, 0.6}, {0.05, 0.8}, {0.06, 0.85}, {0.06, 0.95})});
}
/// 4 bands.
PatchSet saucer() {
  return solid({segment({0, 0}, {0.06, 0}), curve({0.06, 0}, {0.1, 0}, {0.11, 0.012}, {0.14, 0.02}),
                quarterArc({0.14, 0.02}, {0.144, 0.022}, {0.14, 0.024}),
                curve({0.14, 0.024}, {0.1, 0.014}, {0.06, 0.004}, {0, 0.004})});
}
/// 6 bands and the 2 of the handle.
PatchSet cup() {
  PatchSet set = solid(
      {segment({0, 0}, {0.035, 0}), curve({0.035, 0}, {0.045, 0.02}, {0.075, 0.03}, {0.08, 0.07}),
       segment({0.08, 0.07}, {0.085, 0.1}), quarterArc({0.085, 0.1}, {0.083, 0.104}, {0.08, 0.1}),
       segment({0.08, 0.1}, {0.075, 0.07}), curve({0.075, 0.07}, {0.07, 0.03}, {0.04, 0.012}, {0, 0.012})});
  append(set, transformed(handle(0.028, 0.007), glm::translate(glm::dmat4(1.0), {0.078, 0.065, 0.0})));
  return set;
}
/// 7 bands.
PatchSet sugarBowl() {
  return solid({segment({0, 0}, {0.05, 0}), curve({0.05, 0}, {0.1, 0.02}, {0.11, 0.06}, {0.09, 0.1}),
                quarterArc({0.09, 0.1}, {0.095, 0.105}, {0.09, 0.11}),
                curve({0.09, 0.11}, {0.08, 0.13}, {0.05, 0.14}, {0.02, 0.145}),
                curve({0.02, 0.145}, {0.008, 0.147}, {0.008, 0.15}, {0.015, 0.155}),
                quarterArc({0.015, 0.155}, {0.02, 0.16}, {0.015, 0.165}),
                quarterArc({0.015, 0.165}, {0.008, 0.172}, {0, 0.172})});
}

glm::dmat4 at(double x, double y, double z, double turnDeg = 0.0) {
  return glm::rotate(glm::translate(glm::dmat4(1.0), {x, y, z}), glm::radians(turnDeg), {0.0, 1.0, 0.0});
}

}  // namespace

PatchSet teaTable() {
  PatchSet set = tableTop();
  for (const double x : {-0.45, 0.45})
    for (const double z : {-0.45, 0.45}) append(set, transformed(tableLeg(), at(x, 0.0, z)));
  for (int guest = 0; guest < 4; ++guest) {
    const double angle = glm::radians(45.0 + 90.0 * guest);
    const double x = 0.55 * std::cos(angle), z = -0.55 * std::sin(angle);
    append(set, transformed(saucer(), at(x, 1.0, z)));
    append(set, transformed(cup(), at(x, 1.004, z, 30.0 * guest)));
  }
  append(set, transformed(sugarBowl(), at(-0.35, 1.0, 0.1)));
  append(set, transformed(saucer(), glm::scale(at(0.3, 1.0, 0.25), glm::dvec3(1.3))));
  for (const double z : {0.2, 0.29})
    append(set, transformed(surfaces::unitSphere(), glm::scale(at(0.3, 1.05, z), glm::dvec3(0.04))));
  append(set, transformed(teapot(), glm::scale(at(0.0, 1.0, -0.05, 25.0), glm::dvec3(0.1))));
  set = elevated(set, 3, 3);
  surfaces::findNeighbours(set);
  return set;
}

}  // namespace limen::scene
