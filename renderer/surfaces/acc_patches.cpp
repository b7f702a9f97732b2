// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/acc_patches.h"

#include "renderer/surfaces/acc_masks.h"
#include "renderer/surfaces/bernstein.h"
#include "renderer/surfaces/neighbours.h"
#include "renderer/surfaces/patch_builder.h"

namespace limen::surfaces {
namespace {

using BicubicNet = std::array<glm::dvec3, 16>;                // [i + 4 j]
using TangentNet = std::array<std::array<glm::dvec3, 4>, 3>;  // [along][across]: degree 2 and 3

/// The patch of derivatives along u of a face whose vertices are a, b (along u from a), c, d. Of the one
/// along v: the same with the face and net turned over.
TangentNet tangentPatch(const AccMasks& masks, const std::array<uint32_t, 4>& v, const auto& at) {
  TangentNet net;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j)
      net[static_cast<size_t>(i)][static_cast<size_t>(j)] = 3.0 * (at(i + 1, j) - at(i, j));
  net[0][0] = masks.tangent(v[0], v[1]), net[2][0] = -masks.tangent(v[1], v[0]);
  net[0][3] = masks.tangent(v[3], v[2]), net[2][3] = -masks.tangent(v[2], v[3]);
  // On the sides u = 0 and u = 1, across which these tangents point: with the neighbour's they sum to a
  // multiple of the tangent along the side (Loop and Schaefer 2008, section 4).
  const auto correct = [&](size_t column, uint32_t from, uint32_t to, double sign) {
    if (masks.isSharp(from, to)) return;
    const int i = column == 0 ? 0 : 3;
    const glm::dvec3 first = masks.tangent(from, to), middle = 3.0 * (at(i, 2) - at(i, 1)),
                     last = -masks.tangent(to, from);
    const double c0 = masks.cosine(from, to), c1 = masks.cosine(to, from);
    net[column][1] += sign / 3.0 * (2.0 * c0 * middle - c1 * first);
    net[column][2] += sign / 3.0 * (c0 * last - 2.0 * c1 * middle);
  };
  correct(0, v[0], v[3], 1.0);
  correct(2, v[1], v[2], -1.0);
  return net;
}

/// Cross product of two tangent patches, [i + 6 j].
std::array<glm::dvec3, 36> crossProduct(const TangentNet& alongU, const TangentNet& alongV) {
  std::array<glm::dvec3, 36> out{};
  const auto term = [](size_t n, size_t i, size_t m, size_t k) {
    return binomial(n, i) * binomial(m, k) / binomial(n + m, i + k);
  };
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 4; ++j)
      for (size_t k = 0; k < 4; ++k)
        for (size_t l = 0; l < 3; ++l)
          // alongV[l][k] goes with v^l and u^k.
          out[(i + k) + 6 * (j + l)] +=
              term(2, i, 3, k) * term(3, j, 2, l) * glm::cross(alongU[i][j], alongV[l][k]);
  return out;
}

}  // namespace

PatchSet accPatches(const PolygonMesh& mesh, AccNormals normals) {
  const AccMasks masks(mesh);
  PatchSet set;
  for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const std::vector<uint32_t>& v = mesh.faces[f];
    const auto edge = [&](size_t from, size_t to) { return masks.edge(v[from], v[to]); };
    const BicubicNet net = {masks.corner(v[0]), edge(0, 1),        edge(1, 0),        masks.corner(v[1]),
                            edge(0, 3),         masks.inner(f, 0), masks.inner(f, 1), edge(1, 2),
                            edge(3, 0),         masks.inner(f, 3), masks.inner(f, 2), edge(2, 1),
                            masks.corner(v[3]), edge(3, 2),        edge(2, 3),        masks.corner(v[2])};
    std::array<glm::dvec4, 16> points;
    for (size_t i = 0; i < 16; ++i) points[i] = glm::dvec4(net[i], 1.0);
    if (normals == AccNormals::Geometry) {
      addRectangle(set, 3, 3, points);
      continue;
    }
    const TangentNet alongU = tangentPatch(masks, {v[0], v[1], v[2], v[3]},
                                           [&](int i, int j) { return net[static_cast<size_t>(i + 4 * j)]; });
    const TangentNet alongV = tangentPatch(masks, {v[0], v[3], v[2], v[1]},
                                           [&](int i, int j) { return net[static_cast<size_t>(j + 4 * i)]; });
    addRectangle(set, 3, 3, points, 5, crossProduct(alongU, alongV));
  }
  findNeighbours(set);
  return set;
}

}  // namespace limen::surfaces
