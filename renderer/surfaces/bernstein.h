// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "renderer/surfaces/bezier_tables.h"
#include "renderer/surfaces/patch_set.h"

namespace limen::surfaces {

/// Binomial coefficients n over i, 0 <= i <= n <= kMaxDegree, by rows.
inline constexpr std::array<double, (kMaxDegree + 1) * (kMaxDegree + 2) / 2> kBinomials = {LIMEN_BINOMIALS};
constexpr double binomial(size_t n, size_t i) { return kBinomials[n * (n + 1) / 2 + i]; }

/// t^0 to t^n by repeated multiplication.
using Powers = std::array<double, kMaxDegree + 1>;
inline Powers powers(double t, int n) {
  Powers out{};
  out[0] = 1.0;
  for (size_t i = 1; i <= static_cast<size_t>(n); ++i) out[i] = out[i - 1] * t;
  return out;
}

/// Bernstein polynomials B_i^n(t), 0 <= n <= kMaxDegree; s = 1 - t is an argument of its own, so that
/// exchanging t and s reverses the result bit by bit even if neither can be represented exactly.
using Basis = std::array<double, kMaxDegree + 1>;
inline Basis bernstein(int n, double t, double s) {
  const Powers a = powers(t, n), b = powers(s, n);
  Basis out{};
  for (size_t i = 0, last = static_cast<size_t>(n); i <= last; ++i)
    out[i] = binomial(last, i) * (a[i] * b[last - i]);
  return out;
}

/// Sum over i of point(i) B_i^n. Mirrored terms are added first, so that the sum is bitwise the same if both
/// the points and the parameter run the other way: patches that share a boundary agree on it (Schwarz 2009,
/// section 7.6.2). Requires that the compiler contracts no products into fused multiply-adds.
template <class Point>
auto bezierSum(int n, const Basis& basis, Point point) {
  const auto term = [&](int i) { return point(i) * basis[static_cast<size_t>(i)]; };
  auto sum = n == 0 ? term(0) : term(0) + term(n);
  for (int i = 1; 2 * i < n; ++i) sum += term(i) + term(n - i);
  if (n > 0 && n % 2 == 0) sum += term(n / 2);
  return sum;
}

/// Place of the point (i, j, k), i + j + k = n, among those of a triangle of degree n (patch_set.h).
constexpr int triangleIndex(int n, int i, int k) { return (n - i) * (n - i + 1) / 2 + k; }

}  // namespace limen::surfaces
