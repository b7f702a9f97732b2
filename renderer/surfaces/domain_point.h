// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/surfaces/patch_set.h"

namespace limen::surfaces {

/// A point of a patch's parameter domain together with what is left to 1, stored apart: 1 - i/n and
/// (n - i)/n differ in their last bit for some n, and patches that run along a common boundary in opposite
/// directions must agree.
struct DomainPoint {
  double u = 0.0, v = 0.0;
  double restU = 1.0;  ///< rectangle: 1 - u; triangle: w = 1 - u - v
  double restV = 1.0;  ///< rectangle: 1 - v; triangle: unused

  double w() const { return restU; }
};

inline DomainPoint rectanglePoint(double u, double v) { return {u, v, 1.0 - u, 1.0 - v}; }
inline DomainPoint trianglePoint(double u, double v) { return {u, v, 1.0 - u - v, 0.0}; }
inline DomainPoint domainPoint(Domain domain, double u, double v) {
  return domain == Domain::Rectangle ? rectanglePoint(u, v) : trianglePoint(u, v);
}

/// Points of regular grids, 0 <= i <= m, 0 <= j <= n; of a triangle u = i/m, v = j/m, i + j <= m.
inline DomainPoint rectangleGridPoint(int i, int m, int j, int n) {
  return {double(i) / m, double(j) / n, double(m - i) / m, double(n - j) / n};
}
inline DomainPoint triangleGridPoint(int i, int j, int m) {
  return {double(i) / m, double(j) / m, double(m - i - j) / m, 0.0};
}

/// The i-th of m + 1 points of a side, in the side's direction.
inline DomainPoint sidePoint(Domain domain, int side, int i, int m) {
  if (domain == Domain::Triangle) {
    if (side == 0) return triangleGridPoint(m - i, i, m);
    return side == 1 ? triangleGridPoint(0, m - i, m) : triangleGridPoint(i, 0, m);
  }
  if (side == 0) return rectangleGridPoint(i, m, 0, m);
  if (side == 1) return rectangleGridPoint(m, m, i, m);
  return side == 2 ? rectangleGridPoint(m - i, m, m, m) : rectangleGridPoint(0, m, m - i, m);
}

}  // namespace limen::surfaces
