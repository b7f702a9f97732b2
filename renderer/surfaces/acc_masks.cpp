// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/acc_masks.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace limen::surfaces {

AccMasks::AccMasks(const PolygonMesh& mesh) : mesh_(mesh), topology_(mesh) {
  for (uint32_t v = 0; v < mesh.points.size(); ++v) {
    const VertexRing& ring = topology_.rings()[v];
    std::vector<uint32_t>& sharp = sharp_.emplace_back();
    for (const uint32_t end : ring.edges)
      if (isSharp(v, end)) sharp.push_back(end);
    const bool corner = sharp.size() > 2 || ring.faces.empty() || (!ring.closed && ring.faces.size() == 1);
    kinds_.push_back(corner ? Kind::Corner : sharp.size() == 2 ? Kind::Crease : Kind::Smooth);
  }
  for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const std::vector<uint32_t>& face = mesh.faces[f];
    if (face.size() != 4) throw std::invalid_argument("a face is no quad");
    for (size_t c = 0; c < 4; ++c) {
      const std::vector<uint32_t>& around = topology_.rings()[face[c]].faces;
      const auto place = static_cast<size_t>(std::find(around.begin(), around.end(), f) - around.begin());
      const size_t faces = sectorOf(face[c], place).faces;
      // A corner of one face looks like a regular vertex of four.
      const double n = kinds_[face[c]] == Kind::Smooth                 ? double(faces)
                       : kinds_[face[c]] == Kind::Corner && faces == 1 ? 4.0
                                                                       : 2.0 * double(faces);
      const glm::dvec3 sides = mesh.points[face[(c + 1) % 4]] + mesh.points[face[(c + 3) % 4]];
      inner_.push_back((n * mesh.points[face[c]] + 2.0 * sides + mesh.points[face[(c + 2) % 4]]) / (n + 5.0));
    }
  }
  for (uint32_t v = 0; v < mesh.points.size(); ++v) corners_.push_back(cornerPoint(v));
}

bool AccMasks::isSharp(uint32_t a, uint32_t b) const {
  return topology_.sharpness(mesh_, edgeKey(a, b)) >= kInfinitelySharp;
}

glm::dvec3 AccMasks::edge(uint32_t from, uint32_t to) const {
  const std::array<int32_t, 2>& sides = topology_.edges().at(edgeKey(from, to));
  if (isSharp(from, to) && kinds_[from] != Kind::Smooth)
    return (2.0 * mesh_.points[from] + mesh_.points[to]) / 3.0;
  return 0.5 *
         (innerAt(static_cast<uint32_t>(sides[0]), from) + innerAt(static_cast<uint32_t>(sides[1]), from));
}

glm::dvec3 AccMasks::tangent(uint32_t from, uint32_t to) const {
  if (kinds_[from] == Kind::Corner) return 3.0 * (edge(from, to) - corner(from));
  const size_t place = placeOf(from, to);
  if (kinds_[from] == Kind::Smooth) return smoothTangent(from, place);
  // An edge between two sectors begins the one and ends the other; its tangent is the same in both.
  const size_t faces = topology_.rings()[from].faces.size();
  const Sector sector = sectorOf(from, std::min(place, faces - 1));
  return sectorTangent(
      from, sector,
      (place + topology_.rings()[from].edges.size() - sector.first) % topology_.rings()[from].edges.size());
}

double AccMasks::cosine(uint32_t vertex, uint32_t end) const {
  const size_t faces = topology_.rings()[vertex].faces.size();
  if (kinds_[vertex] == Kind::Smooth) return std::cos(2.0 * std::numbers::pi / double(faces));
  if (kinds_[vertex] == Kind::Corner || isSharp(vertex, end)) return 0.0;
  return std::cos(std::numbers::pi / double(sectorOf(vertex, placeOf(vertex, end)).faces));
}

AccMasks::Sector AccMasks::sectorOf(uint32_t vertex, size_t face) const {
  const VertexRing& ring = topology_.rings()[vertex];
  const size_t n = ring.faces.size();
  if (sharp_[vertex].size() < 2) return {0, n};
  const auto sharpAt = [&](size_t place) { return isSharp(vertex, ringEdge(vertex, place)); };
  size_t first = face, faces = 1;
  while (!sharpAt(first)) first = (first + n - 1) % n;
  while (!sharpAt(first + faces)) ++faces;
  return {first, faces};
}

size_t AccMasks::placeOf(uint32_t vertex, uint32_t end) const {
  const std::vector<uint32_t>& edges = topology_.rings()[vertex].edges;
  return static_cast<size_t>(std::find(edges.begin(), edges.end(), end) - edges.begin());
}

uint32_t AccMasks::ringEdge(uint32_t vertex, size_t place) const {
  const std::vector<uint32_t>& edges = topology_.rings()[vertex].edges;
  return edges[place % edges.size()];
}

glm::dvec3 AccMasks::diagonal(uint32_t face, uint32_t vertex) const {
  const std::vector<uint32_t>& v = mesh_.faces[face];
  return mesh_.points[v[static_cast<size_t>(std::find(v.begin(), v.end(), vertex) - v.begin() + 2) % 4]];
}

glm::dvec3 AccMasks::smoothTangent(uint32_t vertex, size_t place) const {
  const VertexRing& ring = topology_.rings()[vertex];
  const size_t n = ring.faces.size();
  const double turn = 2.0 * std::numbers::pi / double(n), half = std::cos(0.5 * turn);
  const double across = 1.0 / (double(n) * std::sqrt(4.0 + half * half));
  glm::dvec3 sum(0.0);
  for (size_t i = 0; i < n; ++i) {
    const size_t at = (place + i) % n;
    sum += (1.0 / double(n) + half * across) * std::cos(turn * double(i)) * mesh_.points[ring.edges[at]];
    sum += across * std::cos(turn * (double(i) + 0.5)) * diagonal(ring.faces[at], vertex);
  }
  return sum;
}

/// Along the edge that is `step` faces from the sector's first: the derivative along the crease turned
/// towards that across it (Biermann, Levin and Zorin 2000), by equal angles from edge to edge.
glm::dvec3 AccMasks::sectorTangent(uint32_t vertex, const Sector& sector, size_t step) const {
  const VertexRing& ring = topology_.rings()[vertex];
  const auto point = [&](size_t i) { return mesh_.points[ringEdge(vertex, sector.first + i)]; };
  const glm::dvec3 along = 0.5 * (point(0) - point(sector.faces));
  if (step == 0) return along;
  if (step == sector.faces) return -along;
  const double turn = std::numbers::pi / double(sector.faces), c = std::cos(turn),
               r = (c + 1.0) / std::sin(turn);
  glm::dvec3 across =
      4.0 * r * (c - 1.0) * mesh_.points[vertex] - r * (1.0 + 2.0 * c) * (point(0) + point(sector.faces));
  for (size_t i = 0; i < sector.faces; ++i) {
    const double before = std::sin(double(i) * turn), after = std::sin(double(i + 1) * turn);
    across += 4.0 * before * point(i) +
              (before + after) * diagonal(ring.faces[(sector.first + i) % ring.faces.size()], vertex);
  }
  across /= double(sector.faces) * (3.0 + c);
  return std::cos(double(step) * turn) * along + std::sin(double(step) * turn) * across;
}

glm::dvec3 AccMasks::innerAt(uint32_t face, uint32_t vertex) const {
  const std::vector<uint32_t>& v = mesh_.faces[face];
  return inner(face, static_cast<size_t>(std::find(v.begin(), v.end(), vertex) - v.begin()));
}

glm::dvec3 AccMasks::cornerPoint(uint32_t v) const {
  if (kinds_[v] == Kind::Corner) return mesh_.points[v];
  if (kinds_[v] == Kind::Crease)
    return (4.0 * mesh_.points[v] + mesh_.points[sharp_[v][0]] + mesh_.points[sharp_[v][1]]) / 6.0;
  glm::dvec3 sum(0.0);
  const std::vector<uint32_t>& faces = topology_.rings()[v].faces;
  for (const uint32_t face : faces) sum += innerAt(face, v);
  return sum / double(faces.size());
}

}  // namespace limen::surfaces
