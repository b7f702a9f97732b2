// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/patch_builder.h"

#include <algorithm>
#include <cassert>

namespace limen::surfaces {

Patch& addRectangle(PatchSet& set, int degreeU, int degreeV, std::span<const glm::dvec4> points,
                    int normalDegree, std::span<const glm::dvec3> normals) {
  Patch patch;
  patch.degreeU = static_cast<uint8_t>(degreeU), patch.degreeV = static_cast<uint8_t>(degreeV);
  patch.normalDegree = static_cast<uint8_t>(normalDegree);
  patch.firstPoint = static_cast<uint32_t>(set.points.size());
  patch.firstNormal = static_cast<uint32_t>(set.normals.size());
  assert(points.size() == static_cast<size_t>(patch.points()));
  assert(normals.size() == static_cast<size_t>(patch.normals()));
  set.points.insert(set.points.end(), points.begin(), points.end());
  set.normals.insert(set.normals.end(), normals.begin(), normals.end());
  return set.patches.emplace_back(patch);
}

Patch& addTriangle(PatchSet& set, int degree, std::span<const glm::dvec4> points, int normalDegree,
                   std::span<const glm::dvec3> normals) {
  Patch patch;
  patch.domain = Domain::Triangle;
  patch.degreeU = patch.degreeV = static_cast<uint8_t>(degree);
  patch.normalDegree = static_cast<uint8_t>(normalDegree);
  patch.firstPoint = static_cast<uint32_t>(set.points.size());
  patch.firstNormal = static_cast<uint32_t>(set.normals.size());
  assert(points.size() == static_cast<size_t>(patch.points()));
  assert(normals.size() == static_cast<size_t>(patch.normals()));
  set.points.insert(set.points.end(), points.begin(), points.end());
  set.normals.insert(set.normals.end(), normals.begin(), normals.end());
  return set.patches.emplace_back(patch);
}

void append(PatchSet& to, const PatchSet& from) {
  const auto points = static_cast<uint32_t>(to.points.size()),
             normals = static_cast<uint32_t>(to.normals.size());
  const auto patches = static_cast<int32_t>(to.patches.size());
  const bool neighbours = to.neighbours.size() == to.patches.size() && !from.neighbours.empty();
  if (!to.trimOf.empty() || !from.trimOf.empty()) {
    const auto trims = static_cast<int32_t>(to.trims.size());
    to.trimOf.resize(to.patches.size());
    to.trims.insert(to.trims.end(), from.trims.begin(), from.trims.end());
    for (PatchTrim trim : from.trimOf) {
      if (trim.region >= 0) trim.region += trims;
      to.trimOf.push_back(trim);
    }
    to.trimOf.resize(to.patches.size() + from.patches.size());
  }
  if (to.motion.moves() || from.motion.moves()) {
    assert(!to.motion.moves() || !from.motion.moves() || to.motion.periodS == from.motion.periodS);
    to.motion.periodS = std::max(to.motion.periodS, from.motion.periodS);
    for (const auto member : {&PatchMotion::sine, &PatchMotion::cosine}) {
      std::vector<glm::dvec3>& vectors = to.motion.*member;
      vectors.resize(to.points.size());
      vectors.insert(vectors.end(), (from.motion.*member).begin(), (from.motion.*member).end());
      vectors.resize(to.points.size() + from.points.size());
    }
  }
  to.points.insert(to.points.end(), from.points.begin(), from.points.end());
  to.normals.insert(to.normals.end(), from.normals.begin(), from.normals.end());
  for (Patch patch : from.patches) {
    patch.firstPoint += points, patch.firstNormal += normals;
    to.patches.push_back(patch);
  }
  if (!neighbours) return to.neighbours.clear();
  for (std::array<Neighbour, 4> sides : from.neighbours) {
    for (Neighbour& side : sides)
      if (side.patch >= 0) side.patch += patches;
    to.neighbours.push_back(sides);
  }
}

PatchSet transformed(PatchSet set, const glm::dmat4& map) {
  const glm::dmat3 turn = glm::transpose(glm::inverse(glm::dmat3(map)));
  for (glm::dvec4& point : set.points) point = map * point;
  for (glm::dvec3& normal : set.normals) normal = turn * normal;
  for (const auto member : {&PatchMotion::sine, &PatchMotion::cosine})
    for (glm::dvec3& vector : set.motion.*member) vector = glm::dmat3(map) * vector;
  return set;
}

}  // namespace limen::surfaces
