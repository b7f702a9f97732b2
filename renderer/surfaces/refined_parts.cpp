// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/refined_parts.h"

#include <algorithm>

#include "renderer/surfaces/normal.h"

namespace limen::surfaces {
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::dvec4;

dvec3 barycentric(dvec2 p) { return {p.x, p.y, 1.0 - p.x - p.y}; }

}  // namespace

ScreenPatches::ScreenPatches(const PatchSet& set, const SurfaceView& view) : set_(set), view_(view) {
  points_.reserve(set.points.size());
  for (const dvec4& p : set.points) points_.push_back(onScreen(p));
}

dvec3 ScreenPatches::onScreen(const dvec4& p) const {
  const dvec3 q = dvec3(p) - p.w * view_.eye;
  return {view_.pxAtDistance * glm::dot(view_.right, q), view_.pxAtDistance * glm::dot(view_.up, q),
          glm::dot(view_.forward, q)};
}

std::span<const dvec3> ScreenPatches::pointsOf(const Part& part, std::array<dvec3, kMostPoints>& out) const {
  const Patch& patch = patchOf(part);
  const dvec3* from = points_.data() + patch.firstPoint;
  if (part.altered) {
    std::transform(part.altered->begin(), part.altered->end(), out.begin(),
                   [&](const dvec4& p) { return onScreen(p); });
  } else if (patch.domain == Domain::Triangle) {
    trianglePart(patch.degreeU, from,
                 {barycentric(part.corners[0]), barycentric(part.corners[1]), barycentric(part.corners[2])},
                 out.data());
  } else {
    rectanglePart(patch.degreeU, patch.degreeV, from, {part.corners[0], part.corners[2]}, out.data());
  }
  return {out.data(), static_cast<size_t>(patch.points())};
}

bool ScreenPatches::isBehind(std::span<const dvec3> points) const {
  return std::any_of(points.begin(), points.end(), [&](const dvec3& p) { return p.z < view_.nearest; });
}

bool ScreenPatches::isOutside(std::span<const dvec3> points) const {
  const dvec2 half = view_.pxAtDistance * view_.tanHalf;
  bool out[5] = {true, true, true, true, true};
  for (const dvec3& p : points) {
    out[0] &= p.x > half.x * p.z, out[1] &= p.x < -half.x * p.z;
    out[2] &= p.y > half.y * p.z, out[3] &= p.y < -half.y * p.z;
    out[4] &= p.z < view_.nearest;
  }
  return std::any_of(std::begin(out), std::end(out), [](bool one) { return one; });
}

std::vector<size_t> sidePlaces(const Patch& patch, int side) {
  const int m = patch.degreeU, n = patch.degreeV;
  std::vector<size_t> out;
  const auto add = [&](int index) { out.push_back(static_cast<size_t>(index)); };
  if (patch.domain == Domain::Triangle) {
    for (int i = 0; i <= m; ++i)
      add(side == 0   ? triangleIndex(m, m - i, 0)
          : side == 1 ? triangleIndex(m, 0, i)
                      : triangleIndex(m, i, m - i));
  } else if (side == 0 || side == 2) {
    for (int i = 0; i <= m; ++i) add(side == 0 ? i : m - i + (m + 1) * n);
  } else {
    for (int j = 0; j <= n; ++j) add(side == 1 ? m + (m + 1) * j : (m + 1) * (n - j));
  }
  return out;
}

std::vector<dvec3> sideOf(const Patch& patch, std::span<const dvec3> points, int side) {
  std::vector<dvec3> out;
  for (const size_t place : sidePlaces(patch, side)) out.push_back(points[place]);
  return out;
}

SurfaceVertices::SurfaceVertices(const PatchSet& set, const SurfaceView& view, dvec3 anchor) : set_(set) {
  out_.anchor = anchor, out_.view = view;
  out_.factors.assign(set.patches.size(), Factors{});
}

uint32_t SurfaceVertices::add(uint32_t patch, dvec2 at, const dvec3& place) {
  const auto [found, fresh] =
      vertices_.try_emplace({patch, at.x, at.y}, static_cast<uint32_t>(out_.positions.size()));
  if (fresh) {
    const Patch& shape = set_.patches[patch];
    const DomainPoint parameter = domainPoint(shape.domain, at.x, at.y);
    out_.positions.emplace_back(place - out_.anchor);
    out_.normals.emplace_back(normalAt(set_, shape, parameter).direction);
    out_.parameters.push_back(parameter);
    out_.patches.push_back(patch);
  }
  return found->second;
}

uint32_t SurfaceVertices::add(uint32_t patch, dvec2 at) {
  const Patch& shape = set_.patches[patch];
  return add(patch, at, evaluate(set_, shape, domainPoint(shape.domain, at.x, at.y), Order::Position).p);
}

void SurfaceVertices::addTriangle(uint32_t patch, glm::uvec3 corners) {
  out_.factors[patch].fill(1);  // drawn
  out_.triangles.push_back(corners);
}

}  // namespace limen::surfaces
