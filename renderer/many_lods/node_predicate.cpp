// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/many_lods/node_predicate.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace limen::many_lods {
namespace {

/// `pixelsPerRad`: of a sphere's diameter, small. Valid: pixelsPerRad 2 r / d < epsilon.
float factorFor(double pixelsPerRad, double epsilonPx) {
  const double q = std::max(2.0 * pixelsPerRad / epsilonPx, 1.0);
  return static_cast<float>(q * q);
}

glm::dvec3 anyPerpendicular(glm::dvec3 axis) {
  return glm::normalize(
      glm::cross(axis, std::abs(axis.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0)));
}

int levelsAbove(uint32_t node, uint32_t leaves) { return std::bit_width(leaves) - std::bit_width(node); }

}  // namespace

CutView hemisphereView(glm::dvec3 eye, glm::dvec3 axisZ, int sidePx, double epsilonPx, double range) {
  CutView view{};
  axisZ = glm::normalize(axisZ);
  const glm::dvec3 x = anyPerpendicular(axisZ), y = glm::cross(axisZ, x);
  // The disc has pi side^2 / 4 pixels for 2 pi of solid angle.
  view.eye = glm::vec4(glm::vec3(eye), factorFor(sidePx / std::sqrt(8.0), epsilonPx));
  view.axisX = glm::vec4(glm::vec3(x), 1.0F);
  view.axisY = glm::vec4(glm::vec3(y), 1.0F);
  view.axisZ = glm::vec4(glm::vec3(axisZ), static_cast<float>(kViewHemisphere));
  view.frustum = glm::vec4(1.0F, 1.0F, static_cast<float>(1.0 / range), 0.0F);
  return view;
}

CutView perspectiveView(glm::dvec3 eye, glm::dvec3 axisZ, glm::dvec3 down, glm::dvec2 tanHalfFov,
                        int heightPx, double epsilonPx, double range) {
  CutView view{};
  axisZ = glm::normalize(axisZ);
  const glm::dvec3 y = glm::normalize(down - axisZ * glm::dot(down, axisZ)), x = glm::cross(y, axisZ);
  view.eye = glm::vec4(glm::vec3(eye), factorFor(heightPx / (2.0 * tanHalfFov.y), epsilonPx));
  view.axisX = glm::vec4(glm::vec3(x), static_cast<float>(tanHalfFov.x));
  view.axisY = glm::vec4(glm::vec3(y), static_cast<float>(tanHalfFov.y));
  view.axisZ = glm::vec4(glm::vec3(axisZ), static_cast<float>(kViewPerspective));
  view.frustum =
      glm::vec4(static_cast<float>(std::hypot(1.0, tanHalfFov.x)),
                static_cast<float>(std::hypot(1.0, tanHalfFov.y)), static_cast<float>(1.0 / range), 0.0F);
  return view;
}

bool isCulled(glm::vec4 sphere, uint32_t node, uint32_t leaves, const CutView& view) {
  const glm::vec3 v = glm::vec3(sphere) - glm::vec3(view.eye);
  const float give = sphere.w + kCullSlack * static_cast<float>(levelsAbove(node, leaves)) *
                                    (std::abs(v.x) + std::abs(v.y) + std::abs(v.z));
  const float depth = v.x * view.axisZ.x + v.y * view.axisZ.y + v.z * view.axisZ.z;
  if (view.axisZ.w == static_cast<float>(kViewHemisphere)) return depth < -give;
  const float x = v.x * view.axisX.x + v.y * view.axisX.y + v.z * view.axisX.z;
  const float y = v.x * view.axisY.x + v.y * view.axisY.y + v.z * view.axisY.z;
  return std::abs(x) - depth * view.axisX.w > give * view.frustum.x ||
         std::abs(y) - depth * view.axisY.w > give * view.frustum.y || depth < -give;
}

bool isValid(glm::vec4 sphere, uint32_t node, uint32_t leaves, const CutView& view) {
  if (node >= leaves) return true;
  const glm::vec3 v = glm::vec3(sphere) - glm::vec3(view.eye);
  if (v.x * v.x + v.y * v.y + v.z * v.z > view.eye.w * (sphere.w * sphere.w)) return true;
  return isCulled(sphere, node, leaves, view);
}

double relativeSize(glm::vec4 sphere, const CutView& view) {
  const double distance = glm::length(glm::dvec3(glm::vec3(sphere)) - glm::dvec3(glm::vec3(view.eye)));
  if (!(distance > double(sphere.w))) return std::numeric_limits<double>::infinity();
  return std::sqrt(double(view.eye.w)) * double(sphere.w) / distance;
}

}  // namespace limen::many_lods
