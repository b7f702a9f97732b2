// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/visibility_fields/cpu_field.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/visibility_fields/all_cores.h"
#include "renderer/visibility_fields/map_functions.h"
#include "renderer/visibility_fields/object_rays.h"

namespace limen::visibility_fields {
namespace {

void traceMap(const ObjectRays& rays, const FieldForm& form, glm::vec3 position, float* shares) {
  constexpr size_t kPacket = ObjectRays::kPacketRays;
  const glm::vec3 z = -position, x = fieldTangent(z), y = fieldBitangent(z);
  const int side = form.directions, code = static_cast<int>(form.directionMap);
  std::array<glm::vec3, kPacket> directions;
  std::array<float*, kPacket> targets;
  std::array<float, kPacket> distances{};
  size_t filled = 0;
  const auto flush = [&] {
    if (filled == 0) return;
    rays.trace(position, {directions.data(), filled}, 3.0F, distances.data());
    for (size_t i = 0; i < filled; ++i) *targets[i] = distances[i] < 0.0F ? -1.0F : 0.5F * distances[i];
    filled = 0;
  };
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) {
      float* const share = shares + (row * side + column);
      *share = -1.0F;
      if (!fieldTexelUsed({column, row}, side, code)) continue;
      const glm::vec3 local = fieldDirection((glm::vec2(column, row) + 0.5F) / float(side), code);
      directions[filled] = local.x * x + local.y * y + local.z * z;
      targets[filled] = share;
      if (++filled == kPacket) flush();
    }
  flush();
}

/// What a share becomes in storage.
void roundShares(std::vector<float>& shares, const FieldForm& form, size_t perMap) {
  const int bits = form.distanceBits > 0 ? form.distanceBits : form.bits;
  if (bits == 32) return;
  for (size_t first = 0; first < shares.size(); first += perMap) {
    double sum = 0.0;
    int hits = 0;
    for (size_t i = first; i < first + perMap; ++i)
      if (shares[i] >= 0.0F) sum += shares[i], ++hits;
    for (size_t i = first; i < first + perMap; ++i)
      if (shares[i] >= 0.0F)
        shares[i] = bits == 1 ? static_cast<float>(sum / hits)
                              : float(fieldHitCode(shares[i], bits)) * fieldCodeStep(bits);
  }
}

}  // namespace

std::vector<float> traceFieldOnCpu(const RigidObject& object, const FieldForm& form) {
  const ObjectRays rays(object.vertices, object.triangles);
  const std::vector<glm::vec3> positions = PositionMap(form.positionMap, form.positions).points();
  const size_t perMap = static_cast<size_t>(form.directions) * static_cast<size_t>(form.directions);
  std::vector<float> shares(positions.size() * perMap);
  onAllCores(positions.size(),
             [&](size_t i) { traceMap(rays, form, positions[i], shares.data() + i * perMap); });
  return shares;
}

CpuField::CpuField(const RigidObject& object, const FieldForm& form)
    : form_(form),
      positions_(form.positionMap, form.positions),
      sphere_(object.sphere),
      owner_(object.owner),
      shares_(traceFieldOnCpu(object, form)) {
  roundShares(shares_, form, static_cast<size_t>(form.directions) * static_cast<size_t>(form.directions));
}

float CpuField::shareFrom(glm::vec3 point, glm::vec3 direction) const {
  return shareOf(positions_.nearest(point), direction);
}

float CpuField::shareTowards(glm::vec3 point, glm::vec3 aim) const {
  const int map = positions_.nearest(point);
  return shareOf(map, glm::normalize(aim - positions_.points()[static_cast<size_t>(map)]));
}

float CpuField::shareOf(int map, glm::vec3 direction) const {
  const glm::vec3 z = -positions_.points()[static_cast<size_t>(map)];
  glm::vec3 local(glm::dot(fieldTangent(z), direction), glm::dot(fieldBitangent(z), direction),
                  glm::dot(z, direction));
  // A ray that grazes the sphere may leave the half space of the nearest position.
  if (local.z < 0.0F) {
    const float length = std::hypot(local.x, local.y);
    local = {local.x / length, local.y / length, 0.0F};
  }
  const glm::ivec2 texel = fieldTexel(local, form_.directions, static_cast<int>(form_.directionMap));
  return shares_[static_cast<size_t>((map * form_.directions + texel.y) * form_.directions + texel.x)];
}

double CpuField::distance(glm::dvec3 origin, glm::dvec3 direction, double slack, bool aimed) const {
  const glm::dvec3 from = (origin - sphere_.centre) / sphere_.radius;
  const double along = -glm::dot(from, direction);
  const glm::dvec3 middle = from + along * direction;
  const double squared = 1.0 - glm::dot(middle, middle);
  if (!(squared > 0.0)) return -1.0;
  const double half = std::sqrt(squared);
  if (!(along + half > 0.0)) return -1.0;
  const bool inside = along < half;
  const glm::vec3 point(glm::normalize(middle + (inside ? half : -half) * direction));
  const glm::vec3 aim(inside ? from : middle);
  const float share =
      aimed ? shareTowards(point, aim) : shareFrom(point, glm::vec3(inside ? -direction : direction));
  if (share < 0.0F) return -1.0;
  if (!inside) return sphere_.radius * (along - half + 2.0 * share);
  const double before = along + half - 2.0 * share;
  if (!(before > 2.0 * slack)) return -1.0;
  if (!aimed) return sphere_.radius * before;
  const float shareAhead = shareTowards(glm::vec3(glm::normalize(middle - half * direction)), aim);
  const double ahead = along - half + 2.0 * shareAhead;
  return sphere_.radius * (shareAhead >= 0.0F && ahead > 2.0 * slack ? std::min(ahead, before) : before);
}

double fieldSpacing(const FieldForm& form) {
  const PositionMap map(form.positionMap, form.positions);
  return std::sqrt(4.0 * M_PI / double(map.points().size())) + std::sqrt(M_PI) / form.directions;
}

}  // namespace limen::visibility_fields
