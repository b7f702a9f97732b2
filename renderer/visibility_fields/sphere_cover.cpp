// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/visibility_fields/sphere_cover.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace limen::visibility_fields {
namespace {

struct Corner {
  glm::dvec3 position, normal;  ///< in units of the object's sphere; no normal: 0
};
struct Facet {
  std::array<Corner, 3> corners;
  uint32_t number;  ///< of the triangle that it is of
};
struct Piece {
  std::vector<Facet> facets;
  Sphere sphere;
};

Piece pieceOf(std::vector<Facet> facets) {
  std::vector<glm::dvec3> points;
  for (const Facet& facet : facets)
    for (const Corner& corner : facet.corners) points.push_back(corner.position);
  return {std::move(facets), boundingSphere(points)};
}

/// The direction in which a surface extends most: of the greatest second moment about its middle.
glm::dvec3 longestAxis(const std::vector<Facet>& facets) {
  double area = 0.0;
  glm::dvec3 middle(0.0);
  glm::dmat3 moments(0.0);
  for (const Facet& f : facets) {
    const glm::dvec3 a = f.corners[0].position, b = f.corners[1].position, c = f.corners[2].position,
                     centre = (a + b + c) / 3.0;
    const double weight = 0.5 * glm::length(glm::cross(b - a, c - a));
    area += weight, middle += weight * centre;
    // Of a triangle: area / 12 (a a' + b b' + c c' + 9 centre centre').
    moments += weight / 12.0 *
               (glm::outerProduct(a, a) + glm::outerProduct(b, b) + glm::outerProduct(c, c) +
                9.0 * glm::outerProduct(centre, centre));
  }
  if (!(area > 0.0)) return {1.0, 0.0, 0.0};
  middle /= area;
  moments = moments / area - glm::outerProduct(middle, middle);
  glm::dvec3 axis = glm::normalize(glm::dvec3(1.0, 0.8, 0.6));
  for (int step = 0; step < 64; ++step) {
    const glm::dvec3 next = moments * axis;
    if (!(glm::length(next) > 0.0)) break;
    axis = glm::normalize(next);
  }
  return axis;
}

Corner between(const Corner& a, const Corner& b, double share) {
  const glm::dvec3 normal = glm::mix(a.normal, b.normal, share);
  const double length = glm::length(normal);
  return {glm::mix(a.position, b.position, share), length > 0.0 ? normal / length : glm::dvec3(0.0)};
}

/// What of a facet lies where `heights`, of its corners over a plane, are positive times `side`.
void appendCut(const Facet& facet, const std::array<double, 3>& heights, double side,
               std::vector<Facet>& out) {
  std::vector<Corner> polygon;
  for (size_t i = 0; i < 3; ++i) {
    const size_t next = (i + 1) % 3;
    const double here = side * heights[i], there = side * heights[next];
    if (here >= 0.0) polygon.push_back(facet.corners[i]);
    if ((here > 0.0 && there < 0.0) || (here < 0.0 && there > 0.0)) {
      // The same place from both sides of the edge and of the plane.
      const bool forward = heights[i] < heights[next];
      const double low = forward ? heights[i] : heights[next], high = forward ? heights[next] : heights[i];
      polygon.push_back(
          between(facet.corners[forward ? i : next], facet.corners[forward ? next : i], low / (low - high)));
    }
  }
  for (size_t i = 2; i < polygon.size(); ++i)
    out.push_back({{polygon[0], polygon[i - 1], polygon[i]}, facet.number});
}

std::pair<std::vector<Facet>, std::vector<Facet>> halves(const std::vector<Facet>& facets) {
  const glm::dvec3 axis = longestAxis(facets);
  double low = 1e300, high = -1e300;
  for (const Facet& facet : facets)
    for (const Corner& corner : facet.corners) {
      const double along = glm::dot(axis, corner.position);
      low = std::min(low, along), high = std::max(high, along);
    }
  std::pair<std::vector<Facet>, std::vector<Facet>> out;
  for (const Facet& facet : facets) {
    std::array<double, 3> heights{};
    for (size_t i = 0; i < 3; ++i)
      heights[i] = glm::dot(axis, facet.corners[i].position) - 0.5 * (low + high);
    const bool flat = heights == std::array<double, 3>{};
    appendCut(facet, heights, 1.0, out.first);
    if (!flat) appendCut(facet, heights, -1.0, out.second);
  }
  return out;
}

RigidObject objectOf(const Piece& piece, const RigidObject& whole) {
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::uvec3> triangles;
  std::vector<uint32_t> numbers;
  for (const Facet& facet : piece.facets) {
    numbers.push_back(facet.number);
    triangles.push_back(glm::uvec3(0, 1, 2) + static_cast<uint32_t>(positions.size()));
    for (const Corner& corner : facet.corners) {
      positions.push_back(whole.sphere.centre + whole.sphere.radius * corner.position);
      if (!whole.normals.empty()) normals.emplace_back(corner.normal);
    }
  }
  RigidObject out = makeRigidObject(whole.name, positions, triangles, normals);
  out.albedo = whole.albedo, out.part = whole.part, out.owner = whole.owner;
  out.numbers = std::move(numbers);
  return out;
}

}  // namespace

std::vector<RigidObject> coverWithSpheres(const RigidObject& object, int spheres) {
  if (spheres <= 1) return {object};
  std::vector<Facet> facets;
  for (size_t number = 0; number < object.triangles.size(); ++number) {
    const glm::uvec3 t = object.triangles[number];
    Facet facet{{}, object.numbers[number]};
    for (int i = 0; i < 3; ++i)
      facet.corners[static_cast<size_t>(i)] = {
          glm::dvec3(object.vertices[t[i]]),
          object.normals.empty() ? glm::dvec3(0.0) : glm::dvec3(object.normals[t[i]])};
    facets.push_back(facet);
  }
  std::vector<Piece> pieces = {pieceOf(std::move(facets))};
  const double whole = std::pow(pieces[0].sphere.radius, 3.0);
  while (pieces.size() < static_cast<size_t>(spheres)) {
    const auto largest = std::max_element(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) {
      return a.sphere.radius < b.sphere.radius;
    });
    auto [first, second] = halves(largest->facets);
    if (first.empty() || second.empty()) break;
    *largest = pieceOf(std::move(first));
    pieces.push_back(pieceOf(std::move(second)));
  }
  double volume = 0.0;
  for (const Piece& piece : pieces) volume += std::pow(piece.sphere.radius, 3.0);
  if (volume >= whole) return {object};
  std::vector<RigidObject> out;
  for (const Piece& piece : pieces)
    if (RigidObject one = objectOf(piece, object); one.sphere.radius > 0.0) out.push_back(std::move(one));
  return out;
}

}  // namespace limen::visibility_fields
