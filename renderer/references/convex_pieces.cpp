// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/references/convex_pieces.h"

#include <algorithm>
#include <cmath>

namespace limen::references {
namespace {

/// Pieces with less area are dropped; ten thousand of them change the sum by 1e-11.
constexpr double kNoArea = 1e-15;

/// Signed area of the triangle (origin, a, b) within the unit disc.
double discTriangle(glm::dvec2 a, glm::dvec2 b) {
  const auto sector = [](glm::dvec2 from, glm::dvec2 to) {
    return 0.5 * std::atan2(cross2(from, to), glm::dot(from, to));
  };
  const glm::dvec2 d = b - a;
  const double dd = glm::dot(d, d);
  if (dd == 0.0) return 0.0;
  // |a + t d| = 1.
  const double half = glm::dot(a, d) / dd, c = (glm::dot(a, a) - 1.0) / dd, discriminant = half * half - c;
  if (discriminant <= 0.0) return sector(a, b);
  const double root = std::sqrt(discriminant);
  const double enter = std::clamp(-half - root, 0.0, 1.0), leave = std::clamp(-half + root, 0.0, 1.0);
  if (enter >= leave) return sector(a, b);
  const glm::dvec2 in = a + enter * d, out = a + leave * d;
  return (enter > 0.0 ? sector(a, in) : 0.0) + 0.5 * cross2(in, out) + (leave < 1.0 ? sector(out, b) : 0.0);
}

}  // namespace

double ConvexPolygon::area() const {
  double twice = 0.0;
  for (int i = 2; i < size_; ++i) twice += cross2((*this)[i - 1] - (*this)[0], (*this)[i] - (*this)[0]);
  return 0.5 * twice;
}

double ConvexPolygon::areaInUnitDisc() const {
  double sum = 0.0;
  for (int i = 0; i < size_; ++i) sum += discTriangle((*this)[i], (*this)[(i + 1) % size_]);
  return sum;
}

void split(const ConvexPolygon& polygon, const HalfPlane& plane, ConvexPolygon& inside,
           ConvexPolygon& outside) {
  inside = outside = ConvexPolygon();
  std::array<double, ConvexPolygon::kCapacity> distance{};
  bool anyInside = false, anyOutside = false;
  for (int i = 0; i < polygon.size(); ++i) {
    const double d = plane.at(polygon[i]);
    distance[static_cast<size_t>(i)] = std::abs(d) <= kOnLine ? 0.0 : d;
    anyInside |= d > kOnLine, anyOutside |= d < -kOnLine;
  }
  if (!anyOutside) return void(inside = polygon);
  if (!anyInside) return void(outside = polygon);
  for (int i = 0; i < polygon.size(); ++i) {
    const int next = (i + 1) % polygon.size();
    const glm::dvec2 a = polygon[i], b = polygon[next];
    const double da = distance[static_cast<size_t>(i)], db = distance[static_cast<size_t>(next)];
    if (da >= 0.0) inside.add(a);
    if (da <= 0.0) outside.add(a);
    if (da * db < 0.0) {
      const glm::dvec2 cut = a + (b - a) * (da / (da - db));
      inside.add(cut), outside.add(cut);
    }
  }
}

void ConvexPieces::keep(const ConvexPolygon& polygon) {
  if (polygon.empty() || polygon.area() < kNoArea) return;
  if (polygon.size() + 2 * 5 <= ConvexPolygon::kCapacity) return next_.push_back(polygon);
  // Each of five cuts may add a vertex: halve a polygon that could outgrow its storage.
  ConvexPolygon first, second;
  const int middle = polygon.size() / 2;
  for (int i = 0; i <= middle; ++i) first.add(polygon[i]);
  for (int i = middle; i <= polygon.size(); ++i) second.add(polygon[i % polygon.size()]);
  next_.push_back(first), next_.push_back(second);
}

void ConvexPieces::subtract(const ConvexRegion& region) {
  next_.clear();
  std::array<ConvexPolygon, 5> cutOff;
  for (const ConvexPolygon& piece : pieces_) {
    glm::dvec2 low = piece[0], high = piece[0];
    for (int i = 1; i < piece.size(); ++i) low = glm::min(low, piece[i]), high = glm::max(high, piece[i]);
    const bool apart =
        low.x >= region.high.x || high.x <= region.low.x || low.y >= region.high.y || high.y <= region.low.y;
    ConvexPolygon rest = piece, inside;
    int cuts = 0;
    for (int i = 0; i < region.count && !apart && !rest.empty(); ++i) {
      split(rest, region.planes[static_cast<size_t>(i)], inside, cutOff[static_cast<size_t>(cuts)]);
      rest = inside;
      cuts += !cutOff[static_cast<size_t>(cuts)].empty();
    }
    if (apart || rest.empty() || rest.area() < kNoArea) {
      next_.push_back(piece);  // not touched: it stays in one piece
      continue;
    }
    for (int i = 0; i < cuts; ++i) keep(cutOff[static_cast<size_t>(i)]);
  }
  std::swap(pieces_, next_);
}

}  // namespace limen::references
