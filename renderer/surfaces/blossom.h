// SPDX-License-Identifier: BSD-3-Clause
// Control points of parts of a patch, straight from those of the whole by its polar form, so that errors do
// not add up over the levels of a subdivision (Farin 2002, sections 4.4 and 17.4).
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "renderer/surfaces/bernstein.h"

namespace limen::surfaces {

/// Corners of a triangular part in barycentric coordinates (u, v, w) of the whole.
using TrianglePart = std::array<glm::dvec3, 3>;
inline constexpr TrianglePart kWholeTriangle = {glm::dvec3{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};

/// The four parts between corners and middles of the sides, all oriented as the whole: three at the corners,
/// then the inner one.
inline std::array<TrianglePart, 4> quartersOf(const TrianglePart& part) {
  const auto& [a, b, c] = part;
  const glm::dvec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
  return {{{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {bc, ca, ab}}};
}

inline constexpr size_t kMostTrianglePoints = (kMaxDegree + 1) * (kMaxDegree + 2) / 2;
inline constexpr size_t kMostPoints = (kMaxDegree + 1) * (kMaxDegree + 1);

/// Control points of the part of a Bézier triangle of degree n, in the order of patch_set.h.
template <class Vector>
void trianglePart(int n, const Vector* points, const TrianglePart& part, Vector* out) {
  std::array<Vector, kMostTrianglePoints> scratch;
  for (int i = n; i >= 0; --i)
    for (int k = 0; k <= n - i; ++k) {
      const int j = n - i - k;
      std::copy_n(points, (n + 1) * (n + 2) / 2, scratch.begin());
      int level = n;
      const auto reduce = [&](const glm::dvec3& at) {
        --level;
        for (int r = level; r >= 0; --r)
          for (int s = 0; s <= level - r; ++s) {
            const auto from = [&](int x, int z) {
              return scratch[static_cast<size_t>(triangleIndex(level + 1, x, z))];
            };
            const Vector next = from(r + 1, s) * at.x + from(r, s) * at.y + from(r, s + 1) * at.z;
            // Of the places still to be read, none comes before this one.
            scratch[static_cast<size_t>(triangleIndex(level, r, s))] = next;
          }
      };
      for (int x = 0; x < i; ++x) reduce(part[0]);
      for (int x = 0; x < j; ++x) reduce(part[1]);
      for (int x = 0; x < k; ++x) reduce(part[2]);
      out[triangleIndex(n, i, k)] = scratch[0];
    }
}

/// Control points of the part [from, to] of a Bézier curve of degree n; points lie `stride` apart.
template <class Vector>
void curvePart(int n, const Vector* points, int stride, double from, double to, Vector* out, int outStride) {
  std::array<Vector, kMaxDegree + 1> scratch;
  for (int i = 0; i <= n; ++i) {
    for (int x = 0; x <= n; ++x) scratch[static_cast<size_t>(x)] = points[x * stride];
    for (int level = n; level > 0; --level) {
      const double t = n - level < i ? to : from;
      for (size_t x = 0; x < static_cast<size_t>(level); ++x)
        scratch[x] = scratch[x] * (1.0 - t) + scratch[x + 1] * t;
    }
    out[i * outStride] = scratch[0];
  }
}

struct RectanglePart {
  glm::dvec2 low{0.0}, high{1.0};
};

/// Control points of the part of an m x n patch, in the order of patch_set.h.
template <class Vector>
void rectanglePart(int m, int n, const Vector* points, const RectanglePart& part, Vector* out) {
  std::array<Vector, kMostPoints> rows;
  for (int j = 0; j <= n; ++j)
    curvePart(m, points + j * (m + 1), 1, part.low.x, part.high.x, &rows[static_cast<size_t>(j * (m + 1))],
              1);
  for (int i = 0; i <= m; ++i)
    curvePart(n, &rows[static_cast<size_t>(i)], m + 1, part.low.y, part.high.y, out + i, m + 1);
}

}  // namespace limen::surfaces
