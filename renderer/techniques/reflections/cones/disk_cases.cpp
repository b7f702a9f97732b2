// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numbers>
#include <vector>

#include "renderer/techniques/reflections/cones/disk_overlap.h"

namespace limen::techniques {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

double signedArea2(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The part of an edge that lies inside the circle.
struct Piece {
  glm::dvec2 start{0.0}, end{0.0};
  bool entersHere = false,
       leavesHere = false;  ///< crosses the circle there, rather than starting or ending at a corner
};

/// From one point of the circle to another, against the clock.
double arcBetween(glm::dvec2 from, glm::dvec2 to) {
  const double angle = std::atan2(from.x * to.y - from.y * to.x, glm::dot(from, to));
  return angle < 0.0 ? angle + kTurn : angle;
}

std::vector<Piece> piecesInside(const std::array<glm::dvec2, 3>& corners) {
  std::vector<Piece> out;
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec2 p = corners[i], edge = corners[(i + 1) % 3] - p;
    const double a = glm::dot(edge, edge), b = glm::dot(p, edge), c = glm::dot(p, p) - 1.0;
    const double discriminant = b * b - a * c;
    if (!(discriminant > 0.0)) continue;
    const double root = std::sqrt(discriminant), first = (-b - root) / a, last = (-b + root) / a;
    if (last <= 0.0 || first >= 1.0) continue;
    Piece piece{p, p + edge, first > 0.0, last < 1.0};
    if (piece.entersHere) piece.start = p + first * edge;
    if (piece.leavesHere) piece.end = p + last * edge;
    out.push_back(piece);
  }
  return out;
}

class Parts {
 public:
  void add(double area, glm::dvec2 centroid) {
    area_ += area;
    moment_ += area * centroid;
  }
  DiskOverlap sum() const { return area_ > 0.0 ? DiskOverlap{area_, moment_ / area_} : DiskOverlap{}; }

 private:
  double area_ = 0.0;
  glm::dvec2 moment_{0.0};
};

void addSegment(Parts& parts, glm::dvec2 from, double angle) {
  const CircularSegment segment = circularSegment(angle);
  const double middle = std::atan2(from.y, from.x) + 0.5 * angle;
  parts.add(segment.area, segment.centroidDistance * glm::dvec2(std::cos(middle), std::sin(middle)));
}

}  // namespace

CircularSegment circularSegment(double angle) {
  // angle - sin(angle) cancels where the angle is small.
  const double squared = angle * angle;
  const double area =
      angle < 0.05
          ? angle * squared / 12.0 * (1.0 - squared / 20.0 * (1.0 - squared / 42.0 * (1.0 - squared / 72.0)))
          : 0.5 * (angle - std::sin(angle));
  if (area <= 0.0) return {0.0, 1.0};
  const double sine = std::sin(0.5 * angle);
  return {area, 2.0 / 3.0 * sine * sine * sine / area};
}

DiskOverlap diskOverlapByCases(const std::array<glm::dvec2, 3>& triangle, DiskCase* found) {
  std::array<glm::dvec2, 3> corners = triangle;
  const double area2 = signedArea2(corners[0], corners[1], corners[2]);
  if (found) *found = {};
  if (!std::isfinite(area2) || area2 == 0.0) return {};
  if (area2 < 0.0) std::swap(corners[1], corners[2]);
  const std::vector<Piece> pieces = piecesInside(corners);
  if (found) {
    for (const glm::dvec2 corner : corners) found->cornersInside += glm::dot(corner, corner) < 1.0;
    for (const Piece& piece : pieces) found->crossings += int(piece.entersHere) + int(piece.leavesHere);
  }
  Parts parts;
  if (pieces.empty()) {
    // Corners 0, crossings 0: the triangle covers the disk, or does not meet it.
    for (size_t i = 0; i < 3; ++i)
      if (signedArea2(corners[i], corners[(i + 1) % 3], glm::dvec2(0.0)) < 0.0) return {};
    return {std::numbers::pi, glm::dvec2(0.0)};
  }
  // The polygon between the pieces, as a fan.
  std::vector<glm::dvec2> outline;
  for (const Piece& piece : pieces) outline.push_back(piece.start), outline.push_back(piece.end);
  for (size_t i = 1; i + 1 < outline.size(); ++i)
    parts.add(0.5 * signedArea2(outline[0], outline[i], outline[i + 1]),
              (outline[0] + outline[i] + outline[i + 1]) / 3.0);
  // A segment wherever the outline leaves the triangle's edges.
  for (size_t i = 0; i < pieces.size(); ++i) {
    const Piece &from = pieces[i], &to = pieces[(i + 1) % pieces.size()];
    if (!from.leavesHere && !to.entersHere) continue;
    double angle = arcBetween(from.end, to.start);
    // Where a corner lies on the circle, rounding may put the entry before the exit.
    if (pieces.size() > 1 && angle > kTurn - 1e-6) angle = 0.0;
    addSegment(parts, from.end, angle);
  }
  return parts.sum();
}

}  // namespace limen::techniques
