// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/lod/bspline_patch.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "renderer/scene/closest_point.h"

namespace limen::scene {
namespace {

using Weights = std::array<double, 4>;

/// Uniform cubic B-spline basis.
Weights basis(double t) {
  const double s = 1.0 - t;
  return {s * s * s / 6.0, (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0,
          (3.0 * s * s * s - 6.0 * s * s + 4.0) / 6.0, t * t * t / 6.0};
}

Weights basisSlope(double t) {
  const double s = 1.0 - t;
  return {-s * s / 2.0, (3.0 * t * t - 4.0 * t) / 2.0, (4.0 * s - 3.0 * s * s) / 2.0, t * t / 2.0};
}

glm::dvec3 weigh(const BicubicPatch& patch, const Weights& u, const Weights& v) {
  glm::dvec3 sum(0.0);
  for (size_t j = 0; j < 4; ++j)
    for (size_t i = 0; i < 4; ++i) sum += u[i] * v[j] * patch.points[i + 4 * j];
  return sum;
}

/// Largest distance from the patch at the same parameters.
double parametricError(const BicubicPatch& patch, int factor) {
  const int points = 8 * factor;
  double largest = 0.0;
  for (int j = 0; j <= points; ++j)
    for (int i = 0; i <= points; ++i) {
      const double u = i / double(points), v = j / double(points);
      largest =
          std::max(largest, glm::length(tessellatedPoint(patch, factor, u, v) - patchPoint(patch, u, v)));
    }
  return largest;
}

}  // namespace

glm::dvec3 patchPoint(const BicubicPatch& patch, double u, double v) {
  return weigh(patch, basis(u), basis(v));
}
glm::dvec3 patchAlongU(const BicubicPatch& patch, double u, double v) {
  return weigh(patch, basisSlope(u), basis(v));
}
glm::dvec3 patchAlongV(const BicubicPatch& patch, double u, double v) {
  return weigh(patch, basis(u), basisSlope(v));
}

Mesh tessellated(const BicubicPatch& patch, int factor) {
  assert(factor > 0);
  Mesh mesh;
  for (int j = 0; j <= factor; ++j)
    for (int i = 0; i <= factor; ++i) {
      const double u = i / double(factor), v = j / double(factor);
      const glm::dvec3 normal = patchNormal(patch, u, v);
      const double length = glm::length(normal);
      mesh.positions.push_back(patchPoint(patch, u, v));
      mesh.normals.emplace_back(length > 0.0 ? glm::vec3(normal / length) : glm::vec3(0.0F));
      mesh.attributes.emplace_back(static_cast<float>(u), static_cast<float>(v), 0.0F, 0.0F);
    }
  const auto row = static_cast<uint32_t>(factor + 1);
  for (uint32_t j = 0; j + 1 < row; ++j)
    for (uint32_t i = 0; i + 1 < row; ++i) {
      const uint32_t corner = j * row + i;
      mesh.triangles.emplace_back(corner, corner + 1, corner + row + 1);
      mesh.triangles.emplace_back(corner, corner + row + 1, corner + row);
    }
  return mesh;
}

glm::dvec3 tessellatedPoint(const BicubicPatch& patch, int factor, double u, double v) {
  const auto cell = [&](double t) { return std::min(static_cast<int>(t * factor), factor - 1); };
  const int i = cell(u), j = cell(v);
  const double x = u * factor - i, y = v * factor - j;
  const auto corner = [&](int di, int dj) {
    return patchPoint(patch, (i + di) / double(factor), (j + dj) / double(factor));
  };
  const glm::dvec3 low = corner(0, 0), high = corner(1, 1);
  // Below the diagonal the second corner is (1, 0), above it (0, 1).
  return y <= x ? low * (1.0 - x) + corner(1, 0) * (x - y) + high * y
                : low * (1.0 - y) + corner(0, 1) * (y - x) + high * x;
}

LodSet patchLevels(const BicubicPatch& patch, const std::vector<int>& factors) {
  LodSet set;
  set.name = "patch";
  for (size_t i = 0; i < factors.size(); ++i) {
    LodMesh level;
    level.mesh = tessellated(patch, factors[i]);
    level.statedError = parametricError(patch, factors[i]);
    if (i > 0) level.deviation = sampledDeviation(set.levels[0].mesh, level.mesh);
    for (const glm::vec4& at : level.mesh.attributes) {
      const int next = factors[std::min(i + 1, factors.size() - 1)];
      // From the integers, so that a vertex shared by both levels stays exactly where it is.
      const double u = std::round(double(at.x) * factors[i]) / factors[i],
                   v = std::round(double(at.y) * factors[i]) / factors[i];
      level.mesh.morphTargets.push_back(tessellatedPoint(patch, next, u, v));
    }
    set.levels.push_back(std::move(level));
  }
  return set;
}

}  // namespace limen::scene
