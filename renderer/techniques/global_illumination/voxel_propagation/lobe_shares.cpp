// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/global_illumination/voxel_propagation/lobe_shares.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/techniques/global_illumination/illumination_bindings.h"

namespace limen::techniques {
namespace {

constexpr int kHeights = 24, kTurns = 48;  // of the directions that stand for a lobe

/// Rounds shares to multiples of 1 / 32767; the largest takes what that leaves of 1.
void wholeSteps(std::array<double, 6>& shares) {
  double sum = 0.0;
  for (double& share : shares) sum += share = std::round(32767.0 * share) / 32767.0;
  *std::max_element(shares.begin(), shares.end()) += 1.0 - sum;
}

}  // namespace

FaceShares faceShares(double focus, glm::dvec3 axis) {
  FaceShares out;
  // Density proportional to mu - t above t and -1. Its mean is (2 + t) / 3 from t = -1 on, else -1 / (3 t).
  const bool cut = focus >= 1.0 / 3.0;
  const double t = cut ? 3.0 * focus - 2.0 : -1.0 / (3.0 * std::max(focus, 1e-9));
  const double low = cut ? 0.0 : std::pow(-1.0 - t, 2.0), high = std::pow(1.0 - t, 2.0);
  const glm::dvec3 helper = std::abs(axis.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(axis, helper)), v = glm::cross(axis, u);
  for (int i = 0; i < kHeights; ++i) {
    const double mu = std::clamp(t + std::sqrt(low + (i + 0.5) / kHeights * (high - low)), -1.0, 1.0);
    const double radius = std::sqrt(1.0 - mu * mu);
    for (int j = 0; j < kTurns; ++j) {
      const double angle = 2.0 * std::numbers::pi * (j + 0.5 * (i % 2)) / kTurns;
      const glm::dvec3 w = mu * axis + radius * (std::cos(angle) * u + std::sin(angle) * v);
      const double sum = std::abs(w.x) + std::abs(w.y) + std::abs(w.z);
      for (int a = 0; a < 3; ++a) {
        const size_t face = size_t(2 * a) + (w[a] < 0.0 ? 1 : 0);
        const double share = std::abs(w[a]) / (sum * kHeights * kTurns);
        out.flux[face] += share;
        out.vector[face] += share * w;
      }
    }
  }
  glm::dvec3 rest = focus * axis;
  for (const glm::dvec3& one : out.vector) rest -= one;
  for (size_t face = 0; face < 6; ++face) out.vector[face] += out.flux[face] * rest;
  return out;
}

std::vector<float> shareTable() {
  const int side = kShareSide, levels = kShareLevels;
  std::vector<float> table(size_t{4} * size_t(side * side * levels * 6));
  for (int level = 0; level < levels; ++level)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const double last = side - 1, a = x / last, z = y / last;
        const glm::dvec3 axis = glm::normalize(glm::dvec3(a * (1.0 - z), (1.0 - a) * (1.0 - z), z));
        FaceShares shares = faceShares(double(level) / (levels - 1), axis);
        wholeSteps(shares.flux);
        for (int face = 0; face < 6; ++face) {
          const int slice = face * levels + level;
          float* texel = &table[4 * (size_t(slice * side + y) * size_t(side) + size_t(x))];
          texel[0] = static_cast<float>(shares.flux[size_t(face)]);
          for (int c = 0; c < 3; ++c) texel[c + 1] = static_cast<float>(shares.vector[size_t(face)][c]);
        }
      }
  return table;
}

}  // namespace limen::techniques
