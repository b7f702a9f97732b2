// SPDX-License-Identifier: BSD-3-Clause
// Tables of basis functions against recursive subdivision in double precision, which knows nothing of them.
#include <gtest/gtest.h>

#include <algorithm>

#include "renderer/scene/curved/double_torus.h"
#include "renderer/surfaces/catmull_clark.h"
#include "renderer/surfaces/loop_point.h"
#include "renderer/surfaces/loop_subdivision.h"
#include "renderer/surfaces/table_layout.h"
#include "tests/renderer/subdivision/meshes.h"

namespace limen::surfaces {
namespace {

std::vector<glm::dvec3> refinedPoints(const TableLayout& layout, const std::vector<glm::dvec3>& points) {
  std::vector<glm::dvec3> out;
  for (const Stencil& entry : layout.entries) {
    glm::dvec3& sum = out.emplace_back(0.0);
    for (const auto& [vertex, w] : entry) sum += w * points[vertex];
  }
  return out;
}

glm::dvec3 pointOf(const TableLayout& layout, const std::vector<glm::dvec3>& refined, const TablePatch& patch,
                   size_t row) {
  const BasisTable& table = layout.tables[patch.table];
  glm::dvec3 out(0.0);
  for (size_t s = 0; s < table.slots; ++s)
    out += table.weight(s, row) * refined[layout.controls[patch.controls[s]].vertex];
  return out;
}

uint32_t vertexOf(const TableLayout& layout, const TablePatch& patch, size_t slot) {
  return layout.controls[patch.controls[slot]].vertex;
}

/// The face of `mesh` with the patch's vertices, and which of its vertices is the patch's first.
std::pair<uint32_t, size_t> faceOf(const TableLayout& layout, const PolygonMesh& mesh,
                                   const TablePatch& patch) {
  for (uint32_t f = 0; f < mesh.faces.size(); ++f)
    for (size_t r = 0; r < mesh.faces[f].size(); ++r) {
      bool same = true;
      for (size_t c = 0; c < mesh.faces[f].size(); ++c)
        same = same && mesh.faces[f][(r + c) % mesh.faces[f].size()] == vertexOf(layout, patch, c);
      if (same) return {f, r};
    }
  throw std::runtime_error("no such face");
}

/// Entries against one recursive step, bit for bit but for the order of sums; then points at random places of
/// every patch against Stam's evaluation of the recursively refined mesh. 1e-6: HOL-02.
void expectLoopSurface(const PolygonMesh& mesh, int level, int each = 4) {
  const TableLayout layout = tableLayout(mesh, SubdivisionScheme::Loop, level);
  const PolygonMesh once = loop(mesh);
  const std::vector<glm::dvec3> refined = refinedPoints(layout, mesh.points);
  ASSERT_EQ(refined.size(), once.points.size());
  for (size_t v = 0; v < refined.size(); ++v) ASSERT_LT(glm::length(refined[v] - once.points[v]), 1e-14) << v;
  scene::Random random(5);
  double most = 0.0;
  for (const TablePatch& patch : layout.patches) {
    const auto [face, rotation] = faceOf(layout, once, patch);
    for (int k = 0; k < each; ++k) {
      const size_t row = std::min<size_t>(layout.rows() - 1, size_t(random.uniform(0.0, layout.rows())));
      const double n = 1 << level, x = layout.places[row][0] / n, y = layout.places[row][1] / n;
      std::array<double, 3> weights{};  // of the face's vertices
      weights[rotation] = 1.0 - x - y, weights[(rotation + 1) % 3] = x, weights[(rotation + 2) % 3] = y;
      const LimitPoint expected = loopPoint(once, face, weights[0], weights[1]);
      most = std::max(most, glm::length(expected.position - pointOf(layout, refined, patch, row)));
    }
  }
  EXPECT_LT(most, 1e-6);
}

void expectRowsSumToOne(const TableLayout& layout) {
  for (const BasisTable& table : layout.tables)
    for (size_t row = 0; row < layout.rows(); ++row) {
      double sum = 0.0;
      for (size_t s = 0; s < table.slots; ++s) sum += table.weight(s, row);
      // Five steps of convex sums of 24 terms: a few hundred roundings of 1e-16.
      ASSERT_NEAR(sum, 1.0, 1e-12);
    }
}

TEST(BasisTables, RowsSumToOneForEveryValence) {
  for (uint32_t valence = 3; valence <= 18; ++valence) {
    expectRowsSumToOne(tableLayout(bipyramid(valence), SubdivisionScheme::Loop, 5));
    expectRowsSumToOne(tableLayout(boundaryFan(valence - 1), SubdivisionScheme::Loop, 5));
    expectRowsSumToOne(tableLayout(bipyramid(valence), SubdivisionScheme::Butterfly, 4));
  }
  expectRowsSumToOne(tableLayout(scene::doubleTorusCage(), SubdivisionScheme::CatmullClark, 5));
}

TEST(BasisTables, LoopEqualsRecursionInsideForEveryValence) {
  for (uint32_t valence = 3; valence <= 18; ++valence) {
    SCOPED_TRACE(valence);
    expectLoopSurface(bipyramid(valence), 5, 2);
  }
}

TEST(BasisTables, LoopEqualsRecursionAtBoundariesForEveryValence) {
  for (uint32_t faces = 1; faces <= 17; ++faces) {
    SCOPED_TRACE(faces);
    expectLoopSurface(boundaryFan(faces), 5, 2);
  }
}

TEST(BasisTables, LoopEqualsRecursionOfLargerMeshesAndOtherLevels) {
  expectLoopSurface(triangulated(scene::doubleTorusCage()), 3);
  expectLoopSurface(openSheet(3, true), 4);
  expectLoopSurface(bipyramid(40), 3, 1);  // beyond the thesis's 18
  PolygonMesh one;
  one.points = {{0, 0, 0}, {1, 0, 0.3}, {0.2, 1, 0}};
  one.faces = {{0, 1, 2}};
  expectLoopSurface(one, 6, 20);
}

/// A crease round the waist, one that ends inside, and three that meet.
TEST(BasisTables, LoopEqualsRecursionAtSharpEdges) {
  PolygonMesh waist = bipyramid(7);
  for (uint32_t i = 0; i < 7; ++i) waist.sharpness[edgeKey(2 + i, 2 + (i + 1) % 7)] = kInfinitelySharp;
  expectLoopSurface(waist, 4);
  PolygonMesh dart = bipyramid(6);
  dart.sharpness[edgeKey(0, 2)] = kInfinitelySharp;
  expectLoopSurface(dart, 4);
  PolygonMesh corner = bipyramid(9);
  for (const uint32_t end : {2U, 5U, 8U}) corner.sharpness[edgeKey(0, end)] = kInfinitelySharp;
  expectLoopSurface(corner, 4);
}

TEST(BasisTables, CatmullClarkEqualsRecursion) {
  for (const PolygonMesh& mesh : {scene::doubleTorusCage(), openSheet(3, false), bipyramid(5)}) {
    const TableLayout layout = tableLayout(mesh, SubdivisionScheme::CatmullClark, 4);
    const PolygonMesh once = catmullClark(mesh);
    const std::vector<glm::dvec3> refined = refinedPoints(layout, mesh.points);
    ASSERT_EQ(refined.size(), once.points.size());
    for (size_t v = 0; v < refined.size(); ++v) ASSERT_LT(glm::length(refined[v] - once.points[v]), 1e-14);
    scene::Random random(5);
    double most = 0.0;
    for (const TablePatch& patch : layout.patches) {
      const auto [face, rotation] = faceOf(layout, once, patch);
      for (int k = 0; k < 4; ++k) {
        const size_t row = std::min<size_t>(layout.rows() - 1, size_t(random.uniform(0.0, layout.rows())));
        double x = layout.places[row][0] / 16.0, y = layout.places[row][1] / 16.0;
        for (size_t turn = 0; turn < rotation; ++turn) x = std::exchange(y, x), x = 1.0 - x;
        const LimitPoint expected = catmullClarkPoint(once, face, x, y);
        most = std::max(most, glm::length(expected.position - pointOf(layout, refined, patch, row)));
      }
    }
    EXPECT_LT(most, 1e-6);
  }
}

/// What several patches take of one another: the same point, but for rounding.
TEST(BasisTables, SidesAndCornersHaveTheSamePointInAllPatches) {
  for (const PolygonMesh& mesh : {bipyramid(5), openSheet(3, true)}) {
    const TableLayout layout = tableLayout(mesh, SubdivisionScheme::Loop, 3);
    const std::vector<glm::dvec3> refined = refinedPoints(layout, mesh.points);
    const int n = 8;
    const auto rowAt = [&](int side, int t) {
      const std::array<Place, 3> from = {Place{0, 0}, {n, 0}, {0, n}};
      const Place &a = from[size_t(side)], &b = from[size_t(side + 1) % 3];
      const Place place = {a[0] + (b[0] - a[0]) / n * t, a[1] + (b[1] - a[1]) / n * t};
      return size_t(std::find(layout.places.begin(), layout.places.end(), place) - layout.places.begin());
    };
    for (const TablePatch& patch : layout.patches)
      for (int side = 0; side < 3; ++side) {
        const uint32_t source = patch.edgeSources[size_t(side)];
        const TablePatch& other = layout.patches[source / 8];
        const int otherSide = int(source / 2 % 4);
        for (int t = 0; t <= n; ++t) {
          const glm::dvec3 own = pointOf(layout, refined, patch, rowAt(side, t)),
                           theirs =
                               pointOf(layout, refined, other, rowAt(otherSide, source % 2 == 1 ? n - t : t));
          ASSERT_LT(glm::length(own - theirs), 1e-13);
        }
      }
  }
}

/// "About 9 MB" of limit weights at level 5, for valences up to 18 inside and at boundaries (section 2.3), if
/// rows have room for 24 weights: 171 to 177 configurations are 9.2 to 9.5 MB. Here corners that stay have
/// tables of their own.
TEST(BasisTables, MemoryIsAsPublished) {
  std::set<std::vector<uint32_t>> keys;
  int64_t padded = 0;
  const auto add = [&](const PolygonMesh& mesh) {
    const TableLayout layout = tableLayout(mesh, SubdivisionScheme::Loop, 0);
    const HalfEdges edges(layout.mesh.vertices, layout.mesh.faces);
    for (uint32_t f = 0; f < layout.mesh.faces.size(); ++f) {
      std::vector<uint32_t> best;
      for (size_t r = 0; r < 3; ++r) {
        std::vector<uint32_t> key = keyOf(surroundingsOf(layout.mesh, edges, f, r, 1));
        if (best.empty() || key < best) best = std::move(key);
      }
      if (keys.insert(best).second) padded += 24 * 561 * 4;
    }
  };
  for (uint32_t valence = 3; valence <= 18; ++valence) add(bipyramid(valence));
  for (uint32_t faces = 1; faces <= 17; ++faces) add(boundaryFan(faces));
  add(openSheet(4, true));
  testing::Test::RecordProperty("configurations", int(keys.size()));
  testing::Test::RecordProperty("bytes", int(padded));
  EXPECT_GT(keys.size(), 16U + 153U);
  EXPECT_LT(double(padded), 1.1 * 9.5e6);
}

}  // namespace
}  // namespace limen::surfaces
