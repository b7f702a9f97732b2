// SPDX-License-Identifier: BSD-3-Clause
// SC-26: fragments subdivided on the GPU against direct evaluation in double precision on the CPU, which the
// tests of surfaces hold against OpenSubdiv.
#include <algorithm>
#include <cstring>
#include <map>

#include "renderer/scene/curved/double_torus.h"
#include "renderer/scene/curved/subdivision_cages.h"
#include "renderer/surfaces/catmull_clark.h"
#include "renderer/surfaces/catmull_clark_point.h"
#include "renderer/techniques/subdivision/fragments/fragment_refinement.h"
#include "renderer/techniques/subdivision/subdivision_bindings.h"
#include "renderer/techniques/subdivision/table_evaluator.h"
#include "renderer/techniques/tessellation/tessellation_bindings.h"
#include "tests/renderer/subdivision/meshes.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

using surfaces::PolygonMesh;

struct MadeFragments {
  PolygonMesh mesh;  ///< whose faces the fragments are
  FragmentLayout layout;
  std::vector<TessellatedVertex> vertices;
  std::vector<uint32_t> indices, byLevel;
};

class Fragments : public TechniqueTest {
 protected:
  static MadeFragments made(const PolygonMesh& cage, int levels, const FlatLevels* flat = nullptr) {
    const scene::Scene scene = makeScene("half_plane");
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, {64, 64});
    surfaces::SubdivisionSurface surface;
    surface.cage = cage;
    surface.scheme = surfaces::SubdivisionScheme::CatmullClark;
    std::optional<TableEvaluator> first(std::in_place, context(), surface, 7, glm::dvec3(0.0),
                                        TableEvaluatorSettings{1, NormalStart::First});
    if (!isSeparated(first->layout().mesh))
      first.emplace(context(), surface, 7, glm::dvec3(0.0), TableEvaluatorSettings{2, NormalStart::Second});
    MadeFragments out{surfaces::catmullClark(cage, first->layout().steps),
                      fragmentLayout(first->layout().mesh, 7),
                      {},
                      {},
                      {}};
    const FragmentRefinement refinement(context(), out.layout, levels, flat);
    frame.begin();
    first->runFirstSteps(frame, 0.0, false);
    refinement.run(frame, first->controls());
    frame.end();
    const AdaptiveTotals totals = refinement.totals().read<AdaptiveTotals>()[0];
    out.vertices = refinement.vertices().read<TessellatedVertex>(0, totals.vertices);
    out.indices = refinement.indices().read<uint32_t>(0, totals.indices);
    out.byLevel = refinement.fragmentsByLevel();
    return out;
  }
};

double extentOf(const PolygonMesh& mesh) {
  glm::dvec3 low(1e300), high(-1e300);
  for (const glm::dvec3& p : mesh.points) low = glm::min(low, p), high = glm::max(high, p);
  return glm::length(high - low);
}

/// Parameters on the face of a place on its fragment, whose (0, 0) is one of the face's corners.
glm::dvec2 onFace(const MadeFragments& made, uint32_t face, double x, double y) {
  const uint32_t first = made.layout.controls[(16 + made.layout.ringPoints) * face + 5];
  const std::vector<uint32_t>& corners = made.mesh.faces[face];
  const auto corner = size_t(std::find(corners.begin(), corners.end(), first) - corners.begin());
  const std::array<glm::dvec2, 4> at = {{{x, y}, {1.0 - y, x}, {1.0 - x, 1.0 - y}, {y, 1.0 - x}}};
  return at[corner];
}

/// Positions within 2e-6 of the cage's diagonal: a step takes a dozen roundings of 6e-8 of a coordinate, some
/// of which the next one's means take back. Normals of n segments a side divide differences of
/// 1 / n of a face, so that they are good to about n 1e-6, and a hundredth of a degree is asked for inside
/// faces. On sharp edges they are those on the fragment's side.
void expectTheLimit(const MadeFragments& made, int levels) {
  const int n = 1 << levels;
  double worst = 0.0, angle = 0.0;
  for (uint32_t f = 0; f < made.mesh.faces.size(); ++f)
    for (int y = 0; y <= n; ++y)
      for (int x = 0; x <= n; ++x) {
        const TessellatedVertex& vertex =
            made.vertices[size_t(f) * size_t((n + 1) * (n + 1)) + size_t(x + (n + 1) * y)];
        const glm::dvec2 at = onFace(made, f, double(x) / n, double(y) / n);
        const surfaces::LimitPoint exact = surfaces::catmullClarkPoint(made.mesh, f, at.x, at.y);
        worst = std::max(worst, glm::length(glm::dvec3(vertex.position) - exact.position));
        if (x == 0 || y == 0 || x == n || y == n) continue;
        angle = std::max(angle, std::acos(std::min(
                                    1.0, glm::dot(glm::normalize(glm::dvec3(vertex.normal)), exact.normal))));
      }
  EXPECT_LT(worst, 2e-6 * extentOf(made.mesh));
  EXPECT_LT(angle, glm::radians(0.01) * n);
}

TEST_F(Fragments, AreTheLimitOfSmoothCages) {
  expectTheLimit(made(scene::doubleTorusCage(), 3), 3);
  expectTheLimit(made(scene::doubleTorusCage(), 2), 2);
  for (const uint32_t valence : {3U, 4U, 5U, 7U, 12U, 24U}) {
    SCOPED_TRACE(valence);
    expectTheLimit(made(surfaces::bipyramid(valence), 2), 2);  // triangles: two steps before
  }
}

TEST_F(Fragments, AreTheLimitAtBoundariesAndCreases) {
  expectTheLimit(made(surfaces::openSheet(3, false), 3), 3);
  for (const scene::CageShape shape :
       {scene::CageShape::Block, scene::CageShape::CreasedBlock, scene::CageShape::CorneredBlock}) {
    SCOPED_TRACE(int(shape));
    expectTheLimit(made(scene::closedCage(shape), 3), 3);
  }
  for (const uint32_t faces : {2U, 3U, 6U}) {
    SCOPED_TRACE(faces);
    expectTheLimit(made(surfaces::boundaryFan(faces), 2), 2);
  }
}

/// On crease edges, normals of either side: against a point a hair inside.
TEST_F(Fragments, HaveTheNormalsOfTheirSideAtCreases) {
  const int levels = 3, n = 1 << levels;
  for (const scene::CageShape shape : {scene::CageShape::CreasedBlock, scene::CageShape::CorneredBlock}) {
    const MadeFragments found = made(scene::closedCage(shape), levels);
    size_t checked = 0;
    for (uint32_t f = 0; f < found.mesh.faces.size(); ++f)
      for (int k = 1; k < n; ++k)
        for (const glm::ivec2 place : {glm::ivec2(k, 0), glm::ivec2(0, k)}) {
          const TessellatedVertex& vertex =
              found.vertices[size_t(f) * size_t((n + 1) * (n + 1)) + size_t(place.x + (n + 1) * place.y)];
          const glm::dvec2 at =
              onFace(found, f, std::max(place.x, 0) / double(n) + (place.x == 0 ? 1e-5 : 0.0),
                     place.y / double(n) + (place.y == 0 ? 1e-5 : 0.0));
          const glm::dvec3 exact = surfaces::catmullClarkPoint(found.mesh, f, at.x, at.y).normal;
          // A hundred-thousandth of a face turns normals by less than a thousandth.
          EXPECT_GT(glm::dot(glm::normalize(glm::dvec3(vertex.normal)), exact), std::cos(2e-3))
              << f << ' ' << k;
          ++checked;
        }
    EXPECT_GT(checked, 100U);
  }
}

/// Of all triangles with an area, every edge of a closed surface belongs to two, once in each direction; its
/// ends the same to the last bit. Levels from the flattest to the finest.
TEST_F(Fragments, OfDifferentLevelsHaveNoCracks) {
  using Bits = std::array<uint32_t, 3>;
  for (const PolygonMesh& cage : {scene::doubleTorusCage(), scene::closedCage(scene::CageShape::CreasedBlock),
                                  surfaces::bipyramid(7)}) {
    size_t mixed = 0;
    for (const double tolerance : {0.002, 0.01, 0.05, 0.25, 1.0}) {
      const FlatLevels flat{.tolerancePx = tolerance};
      const MadeFragments found = made(cage, 5, &flat);
      mixed += std::ranges::count_if(found.byLevel, [](uint32_t of) { return of > 0; }) > 1;
      const auto bits = [&](uint32_t index) {
        Bits out{};
        const glm::vec3 p = found.vertices[index].position + 0.0F;
        std::memcpy(out.data(), &p, sizeof p);
        return out;
      };
      std::map<std::array<Bits, 2>, int> edges;
      for (size_t t = 0; t < found.indices.size(); t += 3) {
        const std::array<Bits, 3> c = {bits(found.indices[t]), bits(found.indices[t + 1]),
                                       bits(found.indices[t + 2])};
        if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) continue;
        for (size_t k = 0; k < 3; ++k) ++edges[{c[k], c[(k + 1) % 3]}];
      }
      EXPECT_GT(edges.size(), 100U);
      size_t open = 0;
      for (const auto& [edge, count] : edges) {
        const auto other = edges.find({edge[1], edge[0]});
        open += count != 1 || other == edges.end() || other->second != 1;
      }
      EXPECT_EQ(open, 0U) << "of " << edges.size();
    }
    EXPECT_GT(mixed, 0U);
  }
}

TEST_F(Fragments, RefuseCreasesThatEndInside) {
  PolygonMesh mesh = scene::doubleTorusCage();
  mesh.sharpness[surfaces::edgeKey(mesh.faces[0][0], mesh.faces[0][1])] = surfaces::kInfinitelySharp;
  EXPECT_THROW(made(mesh, 2), Error);
}

}  // namespace
}  // namespace limen::techniques
