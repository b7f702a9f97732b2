// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/normal.h"

#include <cmath>

#include "renderer/surfaces/bernstein.h"

namespace limen::surfaces {
namespace {

bool usable(glm::dvec3 v) {
  const double length = glm::length(v);
  return std::isfinite(length) && length > 0.0;
}

/// From a point of the boundary across the sides it lies on, from elsewhere towards the middle.
glm::dvec2 directionInwards(Domain domain, const DomainPoint& at) {
  if (domain == Domain::Triangle) {
    const double onU = at.u <= 0.0, onV = at.v <= 0.0, onW = at.w() <= 0.0;
    const glm::dvec2 inward(onU - 0.5 * (onV + onW), onV - 0.5 * (onU + onW));
    return inward == glm::dvec2(0.0) ? glm::dvec2(1.0 / 3.0 - at.u, 1.0 / 3.0 - at.v) : inward;
  }
  const glm::dvec2 inward(double(at.u <= 0.0) - double(at.restU <= 0.0),
                          double(at.v <= 0.0) - double(at.restV <= 0.0));
  return inward == glm::dvec2(0.0) ? glm::dvec2(0.5 - at.u, 0.5 - at.v) : inward;
}

/// Whether the cross product of the tangents says nothing.
bool degenerate(glm::dvec3 a, glm::dvec3 b, glm::dvec3 cross, double diagonal, double tolerance) {
  const double lengthA = glm::length(a), lengthB = glm::length(b);
  // Written so that a NaN counts as degenerate.
  return !(lengthA > tolerance * diagonal && lengthB > tolerance * diagonal &&
           glm::length(cross) > tolerance * lengthA * lengthB);
}

glm::dvec3 fieldAt(const PatchSet& set, const Patch& patch, const DomainPoint& at) {
  const glm::dvec3* const normals = set.normals.data() + patch.firstNormal;
  const int n = patch.normalDegree;
  if (patch.domain == Domain::Triangle) return triangleJet(n, normals, at, Order::Position).p;
  const Basis u = bernstein(n, at.u, at.restU), v = bernstein(n, at.v, at.restV);
  glm::dvec3 out(0.0);
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      out += u[static_cast<size_t>(i)] * v[static_cast<size_t>(j)] * normals[i + (n + 1) * j];
  return out;
}

glm::dvec3 cornerPlane(const PatchSet& set, const Patch& patch) {
  const int sides = sidesOf(patch.domain);
  std::array<glm::dvec3, 4> corners{};
  for (int s = 0; s < sides; ++s)
    corners[static_cast<size_t>(s)] =
        evaluate(set, patch, sidePoint(patch.domain, s, 0, 1), Order::Position).p;
  return sides == 3 ? glm::cross(corners[1] - corners[0], corners[2] - corners[0])
                    : glm::cross(corners[2] - corners[0], corners[3] - corners[1]);
}

}  // namespace

SurfaceNormal geometricNormal(const PatchSet& set, const Patch& patch, const DomainPoint& at,
                              const NormalSettings& settings) {
  const double diagonal = controlDiagonal(set, patch), tolerance = settings.tolerance;
  const SurfaceJet first = evaluate(set, patch, at, Order::First);
  const glm::dvec3 cross = glm::cross(first.u, first.v);
  if (!degenerate(first.u, first.v, cross, diagonal, tolerance))
    return {glm::normalize(cross), NormalRung::Tangents};

  const glm::dvec2 inwards = directionInwards(patch.domain, at);
  const SurfaceJet jet = evaluate(set, patch, at);
  const glm::dvec3 changeU = jet.uu * inwards.x + jet.uv * inwards.y,
                   changeV = jet.uv * inwards.x + jet.vv * inwards.y;
  const glm::dvec3 limit = glm::cross(changeU, jet.v) + glm::cross(jet.u, changeV);
  const double scale = glm::length(changeU) * glm::length(jet.v) + glm::length(jet.u) * glm::length(changeV);
  if (usable(limit) && glm::length(limit) > tolerance * scale && scale > tolerance * diagonal * diagonal)
    return {glm::normalize(limit), NormalRung::Limit};

  const glm::dvec2 step = settings.inward * inwards;
  const SurfaceJet moved =
      evaluate(set, patch, domainPoint(patch.domain, at.u + step.x, at.v + step.y), Order::First);
  const glm::dvec3 movedCross = glm::cross(moved.u, moved.v);
  if (!degenerate(moved.u, moved.v, movedCross, diagonal, tolerance))
    return {glm::normalize(movedCross), NormalRung::Inward};

  const glm::dvec3 plane = cornerPlane(set, patch);
  if (usable(plane) && glm::length(plane) > tolerance * diagonal * diagonal)
    return {glm::normalize(plane), NormalRung::CornerPlane};
  return {};
}

SurfaceNormal normalAt(const PatchSet& set, const Patch& patch, const DomainPoint& at,
                       const NormalSettings& settings) {
  if (patch.normalDegree > 0) {
    const glm::dvec3 field = fieldAt(set, patch, at);
    if (usable(field)) return {glm::normalize(field), NormalRung::Field};
  }
  return geometricNormal(set, patch, at, settings);
}

}  // namespace limen::surfaces
