// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/dart_limit.h"

namespace limen::surfaces {
namespace {

using glm::dvec3;

/// The ring shrinks by about a half in each step. Positions are kept relative to the vertex, so that the
/// ring's shape does not drown in rounding.
constexpr int kSteps = 100;

/// Replaced by that of the ring around the origin, unless the ring has become a line but for rounding: one
/// tangent may shrink faster than the other.
void takeNormal(const std::vector<dvec3>& edges, dvec3& normal) {
  dvec3 area(0.0);
  double size = 0.0;
  for (size_t i = 0; i < edges.size(); ++i) {
    area += glm::cross(edges[i], edges[(i + 1) % edges.size()]);
    size += glm::dot(edges[i], edges[i]);
  }
  if (glm::length(area) > 1e-9 * size) normal = area / size;
}

/// Into coordinates whose origin, `origin`, is the vertex.
void moveToVertex(dvec3& vertex, dvec3& origin, std::vector<dvec3>& edges, std::vector<dvec3>& diagonals) {
  for (dvec3& p : edges) p -= vertex;
  for (dvec3& p : diagonals) p -= vertex;
  origin += vertex;
  vertex = dvec3(0.0);
}

}  // namespace

DartLimit catmullClarkDart(dvec3 vertex, std::vector<dvec3> edges, std::vector<dvec3> diagonals,
                           size_t sharp) {
  const size_t n = edges.size();
  DartLimit out{};
  for (int step = 0; step < kSteps; ++step) {
    moveToVertex(vertex, out.point, edges, diagonals);
    takeNormal(edges, out.normal);
    std::vector<dvec3> faces(n), ends(n);
    dvec3 edgeSum(0.0), faceSum(0.0);
    for (size_t i = 0; i < n; ++i) {
      faces[i] = 0.25 * (vertex + edges[i] + diagonals[i] + edges[(i + 1) % n]);
      edgeSum += edges[i], faceSum += faces[i];
    }
    for (size_t i = 0; i < n; ++i)
      ends[i] = i == sharp ? 0.5 * (vertex + edges[i])
                           : 0.25 * (vertex + edges[i] + faces[i] + faces[(i + n - 1) % n]);
    const auto k = static_cast<double>(n);
    vertex = (k - 2.0) / k * vertex + (edgeSum + faceSum) / (k * k);
    edges = std::move(ends), diagonals = std::move(faces);
  }
  out.point += vertex;
  return out;
}

DartLimit loopDart(dvec3 vertex, std::vector<dvec3> edges, double own, size_t sharp) {
  const size_t n = edges.size();
  std::vector<dvec3> none;
  DartLimit out{};
  for (int step = 0; step < kSteps; ++step) {
    moveToVertex(vertex, out.point, edges, none);
    takeNormal(edges, out.normal);
    std::vector<dvec3> ends(n);
    dvec3 sum(0.0);
    for (size_t i = 0; i < n; ++i) {
      sum += edges[i];
      ends[i] = i == sharp ? 0.5 * (vertex + edges[i])
                           : (3.0 * (vertex + edges[i]) + edges[(i + 1) % n] + edges[(i + n - 1) % n]) / 8.0;
    }
    vertex = (1.0 - own * static_cast<double>(n)) * vertex + own * sum;
    edges = std::move(ends);
  }
  out.point += vertex;
  return out;
}

}  // namespace limen::surfaces
