// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/quadrics.h"

#include <cmath>

#include "renderer/surfaces/patch_builder.h"

namespace limen::surfaces {
namespace {

const double kArcWeight = std::sqrt(0.5);

glm::dvec3 profilePoint(glm::dvec2 p, double weight = 1.0) { return {p * weight, weight}; }

}  // namespace

Profile quarterArc(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
  return {profilePoint(a), profilePoint(b, kArcWeight), profilePoint(c)};
}
Profile segment(glm::dvec2 a, glm::dvec2 b) { return {profilePoint(a), profilePoint(b)}; }
Profile bezierProfile(std::span<const glm::dvec2> points) {
  Profile out;
  for (const glm::dvec2 p : points) out.push_back(profilePoint(p));
  return out;
}

PatchSet revolved(const Profile& profile) {
  // x and z of the quarters' beginnings; turning +x towards -z is counter-clockwise seen from +y.
  constexpr std::array<glm::dvec2, 4> kAlong = {{{1.0, 0.0}, {0.0, -1.0}, {-1.0, 0.0}, {0.0, 1.0}}};
  PatchSet set;
  for (size_t quarter = 0; quarter < 4; ++quarter) {
    const glm::dvec2 a = kAlong[quarter], c = kAlong[(quarter + 1) % 4], b = a + c;
    std::vector<glm::dvec4> net;
    for (const glm::dvec3& p : profile)
      for (const auto& [direction, weight] : {std::pair(a, 1.0), std::pair(b, kArcWeight), std::pair(c, 1.0)})
        net.emplace_back(p.x * weight * direction.x, p.y * weight, p.x * weight * direction.y, p.z * weight);
    addRectangle(set, 2, static_cast<int>(profile.size()) - 1, net);
  }
  return set;
}

PatchSet unitSphere() {
  PatchSet set = revolved(quarterArc({0, -1}, {1, -1}, {1, 0}));
  append(set, revolved(quarterArc({1, 0}, {1, 1}, {0, 1})));
  return set;
}

PatchSet torus(double radius, double tube) {
  const double r = radius, t = tube;
  PatchSet set = revolved(quarterArc({r, -t}, {r + t, -t}, {r + t, 0}));
  append(set, revolved(quarterArc({r + t, 0}, {r + t, t}, {r, t})));
  append(set, revolved(quarterArc({r, t}, {r - t, t}, {r - t, 0})));
  append(set, revolved(quarterArc({r - t, 0}, {r - t, -t}, {r, -t})));
  return set;
}

PatchSet cylinder(double radius, double height) {
  PatchSet set = revolved(segment({0, 0}, {radius, 0}));
  append(set, revolved(segment({radius, 0}, {radius, height})));
  append(set, revolved(segment({radius, height}, {0, height})));
  return set;
}

}  // namespace limen::surfaces
