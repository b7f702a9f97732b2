// SPDX-License-Identifier: BSD-3-Clause
// What the GPU makes of tables, against recursive subdivision on the CPU.
#include <algorithm>
#include <cstring>

#include "renderer/scene/curved/double_torus.h"
#include "renderer/scene/curved/figure.h"
#include "renderer/scene/curved/subdivision_cages.h"
#include "renderer/surfaces/catmull_clark.h"
#include "renderer/surfaces/loop_subdivision.h"
#include "renderer/techniques/subdivision/adaptive_mesh.h"
#include "renderer/techniques/subdivision/subdivision_bindings.h"
#include "renderer/techniques/subdivision/table_evaluator.h"
#include "renderer/techniques/tessellation/tessellation_bindings.h"
#include "tests/renderer/subdivision/meshes.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

using surfaces::PolygonMesh;
using surfaces::SubdivisionScheme;

/// Everything that one frame makes.
struct Made {
  surfaces::TableLayout layout;
  int segments = 0;
  std::vector<ControlVertex> controls;
  std::vector<TessellatedVertex> vertices;
  std::vector<uint32_t> indices;
  std::vector<glm::vec4> attributes;
};

class TablesOnGpu : public TechniqueTest {
 protected:
  static Made made(const surfaces::SubdivisionSurface& surface, const TableEvaluatorSettings& settings,
                   double timeS = 0.0) {
    const scene::Scene scene = makeScene("half_plane");
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, {8, 8});
    TableEvaluator evaluator(context(), surface, 7, glm::dvec3(0.0), settings);
    evaluator.allocateMesh(context());
    frame.begin();
    evaluator.runFirstSteps(frame, timeS);
    evaluator.runMain(frame);
    frame.end();
    return {evaluator.layout(),
            evaluator.segments(),
            evaluator.controls().read<ControlVertex>(),
            evaluator.vertices().read<TessellatedVertex>(),
            evaluator.indices().read<uint32_t>(0, 3 * int64_t{evaluator.triangleCount()}),
            evaluator.attributes() ? evaluator.attributes()->read<glm::vec4>() : std::vector<glm::vec4>()};
  }
  static Made made(const PolygonMesh& mesh, int level, SubdivisionScheme scheme = SubdivisionScheme::Loop,
                   NormalStart normals = NormalStart::First) {
    surfaces::SubdivisionSurface surface;
    surface.cage = mesh;
    surface.scheme = scheme;
    return made(surface, {level, normals});
  }
};

/// Of a face of a recursively refined mesh the vertex at a place: weights, in 1 / n, of the face's vertices.
/// Children of a face are numbered as loop() says.
std::pair<uint32_t, size_t> fineCorner(uint32_t face, std::array<int, 3> w, int n) {
  if (n == 1) return {face, size_t(std::find(w.begin(), w.end(), 1) - w.begin())};
  const int h = n / 2;
  for (uint32_t c = 0; c < 3; ++c) {
    const int own = w[c], next = w[(c + 1) % 3], previous = w[(c + 2) % 3];
    if (own >= h) return fineCorner(4 * face + c, {own - h, next, previous}, h);
  }
  return fineCorner(4 * face + 3, {h - w[2], h - w[0], h - w[1]}, h);
}

/// Places of the three corners of a patch's triangles, in the order in which they are listed.
std::vector<std::array<surfaces::Place, 3>> trianglesOf(int n) {
  std::vector<std::array<surfaces::Place, 3>> out;
  for (int y = 0; y < n; ++y)
    for (int x = 0; x + y < n; ++x) {
      out.push_back({{{x, y}, {x + 1, y}, {x, y + 1}}});
      if (x + y + 2 <= n) out.push_back({{{x + 1, y}, {x + 1, y + 1}, {x, y + 1}}});
    }
  return out;
}

/// Calls visit(drawn vertex, face, corner) for every corner of the drawn triangles, with its face and corner
/// in the mesh refined as often.
template <class Visit>
void forEachCorner(const Made& made, const PolygonMesh& mesh, Visit visit) {
  const PolygonMesh first = surfaces::loop(mesh, made.layout.steps);
  std::map<std::array<uint32_t, 3>, uint32_t> faces;
  for (uint32_t f = 0; f < first.faces.size(); ++f)
    for (size_t r = 0; r < 3; ++r)
      faces[{first.faces[f][r], first.faces[f][(r + 1) % 3], first.faces[f][(r + 2) % 3]}] =
          3 * f + uint32_t(r);
  const auto triangles = trianglesOf(made.segments);
  size_t index = 0;
  for (const surfaces::TablePatch& patch : made.layout.patches) {
    const auto vertex = [&](size_t c) { return made.layout.controls[patch.controls[c]].vertex; };
    const uint32_t found = faces.at({vertex(0), vertex(1), vertex(2)});
    for (const auto& triangle : triangles)
      for (const surfaces::Place& place : triangle) {
        std::array<int, 3> weights{};
        weights[found % 3] = made.segments - place[0] - place[1];
        weights[(found + 1) % 3] = place[0], weights[(found + 2) % 3] = place[1];
        const auto [face, corner] = fineCorner(found / 3, weights, made.segments);
        visit(made.indices[index++], face, corner);
      }
  }
  EXPECT_EQ(index, made.indices.size());
}

/// Largest distance of drawn vertices from the limits of the recursively refined mesh, every triangle's
/// corners taken by its place; and largest angle of normals from the limit's [rad].
struct Errors {
  double position = 0.0, normal = 0.0;
};
Errors errorsOf(const Made& made, const PolygonMesh& mesh) {
  const PolygonMesh fine = surfaces::loop(mesh, made.layout.steps + int(std::log2(made.segments)));
  const surfaces::LoopLimit limit = surfaces::loopLimit(fine);
  Errors out;
  forEachCorner(made, mesh, [&](uint32_t index, uint32_t face, size_t corner) {
    const TessellatedVertex& drawn = made.vertices[index];
    out.position = std::max(out.position,
                            glm::length(glm::dvec3(drawn.position) - limit.points[fine.faces[face][corner]]));
    out.normal =
        std::max(out.normal,
                 std::acos(std::min(1.0, glm::dot(glm::dvec3(drawn.normal), limit.normals[face][corner]))));
  });
  return out;
}

PolygonMesh figureCage() { return scene::figureOfTriangles().cage; }

TEST_F(TablesOnGpu, TheFigureIsTheSizeOfTheBigGuy) {
  const PolygonMesh cage = figureCage();
  EXPECT_EQ(cage.points.size(), 1450U);
  EXPECT_EQ(cage.faces.size(), 2896U);
  EXPECT_FALSE(surfaces::findFault(cage.points.size(), cage.faces).has_value());
  std::vector<int> valence(cage.points.size());
  for (const auto& face : cage.faces)
    for (const uint32_t v : face) ++valence[v];
  EXPECT_EQ(*std::min_element(valence.begin(), valence.end()), 3);
  EXPECT_EQ(*std::max_element(valence.begin(), valence.end()), 7);
  EXPECT_EQ(scene::figureOfQuads().cage.faces.size(), 1448U);
}

/// HOL-04, HOL-05: sums of floats, of at most 19 terms: 19 roundings of 6e-8 of extents below 3 for
/// positions; normals from cross products of such positions, where fans are no smaller than a tenth.
TEST_F(TablesOnGpu, FirstStepEqualsTheCpu) {
  for (const PolygonMesh& mesh :
       {surfaces::bipyramid(7), surfaces::boundaryFan(5), surfaces::openSheet(3, true)}) {
    const Made found = made(mesh, 2);
    const PolygonMesh first = surfaces::loop(mesh);
    std::vector<glm::dvec3> normals(first.points.size(), glm::dvec3(0.0));
    for (const std::vector<uint32_t>& f : first.faces) {
      const glm::dvec3 &a = first.points[f[0]], &b = first.points[f[1]], &c = first.points[f[2]];
      for (const uint32_t v : f) normals[v] += glm::cross(b - a, c - a);
    }
    ASSERT_EQ(found.controls.size(), first.points.size());
    for (size_t v = 0; v < first.points.size(); ++v) {
      EXPECT_LT(glm::length(glm::dvec3(found.controls[v].position) - first.points[v]), 5e-6);
      EXPECT_LT(glm::length(glm::dvec3(found.controls[v].normal) - glm::normalize(normals[v])), 1e-4);
    }
  }
}

/// HOL-08. Weights of 24 slots in single precision: 24 roundings of 6e-8, of extents up to 5.
TEST_F(TablesOnGpu, VerticesAreLimitPointsAtEveryLevel) {
  for (int level = 1; level <= 5; ++level)
    for (const PolygonMesh& mesh : {surfaces::bipyramid(3), surfaces::bipyramid(18), surfaces::boundaryFan(4),
                                    surfaces::boundaryFan(1), surfaces::openSheet(3, true)}) {
      EXPECT_LT(errorsOf(made(mesh, level), mesh).position, 1e-5) << level;
    }
  EXPECT_LT(errorsOf(made(figureCage(), 3), figureCage()).position, 1e-5);
}

/// What flat triangles between limit points leave out: the distance of their edges' middles from the limit
/// points there. It falls at every level: to a quarter where the surface is smooth, and next to extraordinary
/// vertices by the ratio of the eigenvalue that bends it, which is below the subdominant one: 0.63 at most,
/// the limit of high valences.
TEST_F(TablesOnGpu, ErrorOfTrianglesFallsWithEveryLevel) {
  for (const PolygonMesh& mesh :
       {surfaces::bipyramid(3), surfaces::bipyramid(7), surfaces::openSheet(3, true)}) {
    double before = 1e9;
    for (int level = 1; level <= 5; ++level) {
      const Made found = made(mesh, level);
      const PolygonMesh first = surfaces::loop(mesh), fine = surfaces::loop(mesh, level + 1);
      const surfaces::LoopLimit limit = surfaces::loopLimit(fine);
      std::map<std::array<uint32_t, 3>, uint32_t> faces;
      for (uint32_t f = 0; f < first.faces.size(); ++f)
        for (size_t r = 0; r < 3; ++r)
          faces[{first.faces[f][r], first.faces[f][(r + 1) % 3], first.faces[f][(r + 2) % 3]}] =
              3 * f + uint32_t(r);
      const auto triangles = trianglesOf(found.segments);
      double error = 0.0;
      size_t index = 0;
      for (const surfaces::TablePatch& patch : found.layout.patches) {
        const auto vertex = [&](size_t c) { return found.layout.controls[patch.controls[c]].vertex; };
        const uint32_t face = faces.at({vertex(0), vertex(1), vertex(2)});
        for (const auto& triangle : triangles) {
          for (size_t c = 0; c < 3; ++c) {
            const surfaces::Place &a = triangle[c], &b = triangle[(c + 1) % 3];
            std::array<int, 3> weights{};
            weights[(face + 1) % 3] = a[0] + b[0], weights[(face + 2) % 3] = a[1] + b[1];
            weights[face % 3] = 2 * found.segments - a[0] - b[0] - a[1] - b[1];
            const auto [fineFace, corner] = fineCorner(face / 3, weights, 2 * found.segments);
            const glm::dvec3 middle =
                0.5 * (glm::dvec3(found.vertices[found.indices[index + c]].position) +
                       glm::dvec3(found.vertices[found.indices[index + (c + 1) % 3]].position));
            error = std::max(error, glm::length(middle - limit.points[fine.faces[fineFace][corner]]));
          }
          index += 3;
        }
      }
      EXPECT_LT(error, 0.65 * before) << level;
      before = error;
    }
  }
}

/// HOL-10. Normals from tables of tangents are those of the limit: 1e-3 rad, as tangents lose digits at
/// valence
/// 18. The others are what they are: they start from triangles, and the finer these, the nearer.
TEST_F(TablesOnGpu, NormalsByTheirStart) {
  const PolygonMesh mesh = surfaces::triangulated(scene::doubleTorusCage());
  const auto error = [&](NormalStart start) {
    return errorsOf(made(mesh, 4, SubdivisionScheme::Loop, start), mesh).normal;
  };
  const double cage = error(NormalStart::Cage), first = error(NormalStart::First),
               second = error(NormalStart::Second), geometry = error(NormalStart::Geometry);
  EXPECT_LT(geometry, 1e-3);
  EXPECT_LT(second, first);
  EXPECT_LT(first, cage);
  EXPECT_GT(second, 0.01);
  std::printf("largest angle [deg]: cage %.2f, first %.2f, second %.2f, geometry %.4f\n", cage * 180 / M_PI,
              first * 180 / M_PI, second * 180 / M_PI, geometry * 180 / M_PI);
  EXPECT_LT(errorsOf(made(surfaces::boundaryFan(4), 4, SubdivisionScheme::Loop, NormalStart::Geometry),
                     surfaces::boundaryFan(4))
                .normal,
            1e-3);
}

/// HOL-06: every edge of a closed mesh has two triangles, in opposite directions, and the surface is a
/// sphere's or a double torus's by its Euler characteristic.
TEST_F(TablesOnGpu, ClosedMeshesHaveNoOpenEdges) {
  const auto characteristic = [&](const Made& found) {
    std::set<std::array<uint32_t, 2>> directed;
    std::set<uint32_t> used(found.indices.begin(), found.indices.end());
    for (size_t i = 0; i < found.indices.size(); i += 3)
      for (size_t c = 0; c < 3; ++c) {
        const bool added = directed.insert({found.indices[i + c], found.indices[i + (c + 1) % 3]}).second;
        EXPECT_TRUE(added);
      }
    for (const auto& [a, b] : directed) EXPECT_TRUE(directed.contains({b, a}));
    EXPECT_EQ(used.size(), found.vertices.size());
    return int64_t(used.size()) - int64_t(directed.size() / 2) + int64_t(found.indices.size() / 3);
  };
  EXPECT_EQ(characteristic(made(surfaces::bipyramid(5), 4)), 2);
  EXPECT_EQ(characteristic(made(surfaces::triangulated(scene::doubleTorusCage()), 3)), -2);
  EXPECT_EQ(characteristic(made(scene::doubleTorusCage(), 3, SubdivisionScheme::CatmullClark)), -2);
  EXPECT_EQ(characteristic(made(surfaces::bipyramid(8), 3, SubdivisionScheme::Butterfly)), 2);
}

/// Both sides of a crease have vertices of their own, with normals of their own, at the same places bit by
/// bit.
TEST_F(TablesOnGpu, CreasesHaveTwoNormalsAndOnePosition) {
  PolygonMesh mesh = surfaces::bipyramid(6);
  for (uint32_t i = 0; i < 6; ++i)
    mesh.sharpness[surfaces::edgeKey(2 + i, 2 + (i + 1) % 6)] = surfaces::kInfinitelySharp;
  const Made found = made(mesh, 4);
  std::map<std::array<float, 3>, std::vector<glm::vec3>> normals;
  for (const TessellatedVertex& v : found.vertices)
    normals[{v.position.x, v.position.y, v.position.z}].push_back(v.normal);
  size_t split = 0;
  for (const auto& [at, of] : normals) {
    ASSERT_LE(of.size(), 2U);
    if (of.size() < 2) continue;
    ++split;
    EXPECT_LT(glm::dot(of[0], of[1]), 0.9F);
  }
  EXPECT_EQ(split, 6U * 16U);  // 16 segments along each edge of the control mesh
  EXPECT_LT(errorsOf(found, mesh).position, 1e-5);
}

/// HOL-13: joints move the control mesh, and nothing else is made anew.
TEST_F(TablesOnGpu, ThePoseIsThatOfTheJoints) {
  const surfaces::SubdivisionSurface figure = scene::figureOfTriangles();
  PolygonMesh posed = figure.cage;
  posed.points = surfaces::skinned(figure, 0.3);
  double moved = 0.0;
  for (size_t v = 0; v < posed.points.size(); ++v)
    moved = std::max(moved, glm::length(posed.points[v] - figure.cage.points[v]));
  EXPECT_GT(moved, 0.1);
  EXPECT_LT(errorsOf(made(figure, {2, NormalStart::First}, 0.3), posed).position, 1e-5);
}

/// An affine map of the control mesh is one of the surface: a property of all schemes, and the Butterfly
/// scheme keeps the control mesh's vertices and, on a regular grid, cubic functions (Dyn et al. 1990).
TEST_F(TablesOnGpu, ButterflyKeepsVerticesAndCubics) {
  const PolygonMesh mesh = surfaces::bipyramid(7);
  const Made found = made(mesh, 4, SubdivisionScheme::Butterfly);
  for (const glm::dvec3& p : mesh.points)
    EXPECT_TRUE(std::any_of(found.vertices.begin(), found.vertices.end(), [&](const TessellatedVertex& v) {
      return glm::length(glm::dvec3(v.position) - p) < 1e-6;
    }));
  // A torus of regular triangles, whose heights are a cubic on part of it.
  constexpr uint32_t kSide = 12;
  PolygonMesh torus;
  const auto height = [](double x, double y) { return 0.02 * x * x * x - 0.03 * x * y * y + 0.05 * y * x; };
  for (uint32_t y = 0; y < kSide; ++y)
    for (uint32_t x = 0; x < kSide; ++x) torus.points.emplace_back(x, y, height(x - 6.0, y - 6.0));
  for (uint32_t y = 0; y < kSide; ++y)
    for (uint32_t x = 0; x < kSide; ++x) {
      const uint32_t right = (x + 1) % kSide, up = (y + 1) % kSide;
      const uint32_t a = x + kSide * y, b = right + kSide * y, c = right + kSide * up, d = x + kSide * up;
      torus.faces.insert(torus.faces.end(), {{a, b, c}, {a, c, d}});
    }
  const Made regular = made(torus, 4, SubdivisionScheme::Butterfly);
  const size_t each = 3 * size_t(regular.segments) * size_t(regular.segments);
  int inside = 0;
  for (size_t p = 0; p < regular.layout.patches.size(); ++p) {
    const uint32_t square = regular.layout.patches[p].parent / 2;
    const int x = int(square % kSide) - 6, y = int(square / kSide) - 6;
    if (x < -2 || x > 1 || y < -2 || y > 1) continue;  // three squares away from where the cubic ends
    for (size_t i = 0; i < each; ++i) {
      const glm::dvec3 at(regular.vertices[regular.indices[each * p + i]].position);
      ++inside;
      // Heights of up to 10 in floats.
      EXPECT_NEAR(at.z, height(at.x - 6.0, at.y - 6.0), 1e-5);
    }
  }
  EXPECT_GT(inside, 1000);
}

TEST_F(TablesOnGpu, WhatDoesNotFitIsRefusedInWords) {
  EXPECT_THROW(made(surfaces::bipyramid(70), 2), Error);
  EXPECT_THROW(made(surfaces::bipyramid(5), 1, SubdivisionScheme::Loop, NormalStart::Second), Error);
  EXPECT_THROW(made(surfaces::bipyramid(5), 2, SubdivisionScheme::CatmullClark, NormalStart::Geometry),
               Error);
}

/// Directed edges, between places, that have no partner the other way. Triangles with two corners in one
/// place have no edges that count.
size_t openEdges(const std::vector<TessellatedVertex>& vertices, const std::vector<uint32_t>& indices,
                 size_t& triangles) {
  using Key = std::array<float, 3>;
  std::map<std::pair<Key, Key>, int> balance;
  triangles = 0;
  for (size_t i = 0; i < indices.size(); i += 3) {
    std::array<Key, 3> at;
    for (size_t c = 0; c < 3; ++c) {
      const glm::vec3 p = vertices.at(indices[i + c]).position;
      at[c] = {p.x, p.y, p.z};
    }
    if (at[0] == at[1] || at[1] == at[2] || at[2] == at[0]) continue;
    ++triangles;
    for (size_t c = 0; c < 3; ++c) {
      const Key &a = at[c], &b = at[(c + 1) % 3];
      balance[a < b ? std::pair(a, b) : std::pair(b, a)] += a < b ? 1 : -1;
    }
  }
  return size_t(
      std::count_if(balance.begin(), balance.end(), [](const auto& entry) { return entry.second != 0; }));
}

/// HOL-11. Attributes at every corner are the limits of their own mesh, refined by recursion in double
/// precision: 12 products of values up to 1 in single precision. Seams divide them, and positions stay closed
/// in every bit.
TEST_F(TablesOnGpu, AttributesEqualRecursionAndSeamsKeepThemApart) {
  surfaces::SubdivisionSurface surface = scene::seamedRing(false);
  const PolygonMesh values = surfaces::attributeMesh(surface.cage, *surface.attributes);
  const Made found = made(surface, {4, NormalStart::First});
  ASSERT_EQ(found.attributes.size(), found.vertices.size());
  const PolygonMesh fine = surfaces::loop(values, 4);
  const surfaces::LoopLimit limit = surfaces::loopLimit(fine);
  double error = 0.0;
  forEachCorner(found, surface.cage, [&](uint32_t index, uint32_t face, size_t corner) {
    error = std::max(
        error, glm::length(glm::dvec3(found.attributes[index]) - limit.points[fine.faces[face][corner]]));
  });
  EXPECT_LT(error, 2e-6);
  EXPECT_LT(errorsOf(found, surface.cage).position, 1e-5);
  size_t triangles = 0;
  EXPECT_EQ(openEdges(found.vertices, found.indices, triangles), 0U);
  EXPECT_EQ(triangles, 120U * 256U);
  // Two seams of 10 and 6 edges, each of 16 segments: two values at each of their places and four where they
  // cross.
  std::map<std::array<float, 3>, std::set<std::array<float, 2>>> at;
  for (size_t v = 0; v < found.vertices.size(); ++v) {
    const glm::vec3 p = found.vertices[v].position;
    at[{p.x, p.y, p.z}].insert({found.attributes[v].x, found.attributes[v].y});
  }
  std::map<size_t, size_t> places;
  for (const auto& [position, several] : at) ++places[several.size()];
  EXPECT_EQ(places[2], 16U * 16U - 2U);
  EXPECT_EQ(places[4], 1U);
  EXPECT_EQ(places.size(), 3U);
  // Where no seam is near, weights are shared: fewer tables than twice as many.
  surface.attributes.reset();
  const Made plain = made(surface, {4, NormalStart::First});
  size_t shared = 0;
  for (const surfaces::TablePatch& patch : found.layout.patches)
    shared += patch.attributeTable == patch.table;
  // Patches without a corner or side on either seam: of 20 x 12 squares of the first step those not beside
  // one.
  EXPECT_EQ(shared, 2U * 18U * 10U);
  EXPECT_EQ(plain.layout.tables.size(), 1U);
}

/// HOL-09: random real levels, with and without morphing, leave no open edge in any bit; neither do levels by
/// length.
TEST_F(TablesOnGpu, LevelsOfEdgesLeaveNoCracks) {
  const scene::Scene scene = makeScene("half_plane");
  const frame::GpuScene gpuScene(scene);
  frame::Frame frame(context(), scene, gpuScene, {64, 64});
  for (const SubdivisionScheme scheme : {SubdivisionScheme::Loop, SubdivisionScheme::CatmullClark})
    for (const EdgeLevels by : {EdgeLevels::Random, EdgeLevels::ByLength})
      for (const bool morph : {false, true}) {
        surfaces::SubdivisionSurface surface;
        surface.scheme = scheme;
        surface.cage = scheme == SubdivisionScheme::Loop ? surfaces::triangulated(scene::doubleTorusCage())
                                                         : scene::doubleTorusCage();
        const TableEvaluator evaluator(context(), surface, 0, glm::dvec3(0.0), {5, NormalStart::First});
        const AdaptiveMesh mesh(context(), evaluator, {by, 1.5, morph});
        frame.begin();
        evaluator.runFirstSteps(frame, 0.0);
        mesh.run(frame);
        frame.end();
        const AdaptiveTotals totals = mesh.totals().read<AdaptiveTotals>()[0];
        ASSERT_EQ(totals.indices, 3 * totals.triangles);
        const auto vertices = mesh.vertices().read<TessellatedVertex>(0, totals.vertices);
        const auto indices = mesh.indices().read<uint32_t>(0, totals.indices);
        size_t triangles = 0;
        EXPECT_EQ(openEdges(vertices, indices, triangles), 0U) << int(by) << morph;
        EXPECT_GT(triangles, evaluator.layout().patches.size());
        // Fewer than uniformly at the finest level.
        EXPECT_LT(triangles, size_t(evaluator.triangleCount()));
      }
}

/// Finer segments give a better picture, and a level for each edge fewer triangles for it than one for all.
TEST_F(TablesOnGpu, ErrorFallsWithTheLengthOfSegments) {
  const scene::Scene scene = makeScene("curved/control_mesh", {{"cage", std::string("double_torus")}});
  const Image recursive = render(scene, "subdivision/recursive", {{"level", int64_t{6}}}, {160, 120}).product;
  double before = 1.0;
  for (const double segmentPx : {64.0, 16.0, 4.0}) {
    const Rendered found = render(scene, "subdivision/tables",
                                  {{"level", int64_t{6}},
                                   {"normals", std::string("geometry")},
                                   {"refinement", std::string("edges")},
                                   {"refinement.segment_px", segmentPx}},
                                  {160, 120}, true);
    const double error = meanDifference(found.product, recursive);
    EXPECT_LT(error, before) << segmentPx;
    before = error;
  }
}

/// Of the same technique in other forms. Positions are the same bits, so coverage is; inner vertices of the
/// driver's pattern for triangles lie elsewhere on nearly the same surface.
TEST_F(TablesOnGpu, FormsDrawTheSamePicture) {
  for (const std::string scheme : {"loop", "catmull_clark"}) {
    const scene::Scene scene =
        makeScene("curved/control_mesh", {{"cage", std::string("double_torus")}, {"scheme", scheme}});
    const auto picture = [&](const std::string& form) {
      return render(scene, "subdivision/tables", {{"form", form}, {"level", int64_t{4}}}, {160, 120}).product;
    };
    const Image compute = picture("compute"), instanced = picture("instanced"),
                stages = picture("tessellation_stages");
    // Shading differs by the order of sums of normals (1e-7). A GPU rasterises the one in compute and the
    // other by the driver, which snaps corners to 1/256 px: silhouettes cross some 600 pixels, of which 2 in
    // 128 have their centre within 1/128 px of an edge; elsewhere shading, which changes by 0.02 a pixel at
    // most over a third of the picture, moves by as much: 0.02 / 256 / 3.
    size_t elsewhere = 0;
    double sum = 0.0;
    for (size_t pixel = 0; pixel < compute.pixels(); ++pixel) {
      const double difference = std::abs(compute.data[4 * pixel] - instanced.data[4 * pixel]);
      if (difference > 1e-3)
        ++elsewhere;
      else
        sum += difference;
    }
    EXPECT_LE(elsewhere, 10U) << scheme;
    EXPECT_LT(sum / double(compute.pixels()), 2.7e-5) << scheme;
    EXPECT_LT(meanDifference(compute, stages), 2e-3) << scheme;
    const Image recursive =
        render(scene, "subdivision/recursive", {{"level", int64_t{4}}}, {160, 120}).product;
    EXPECT_LT(meanDifference(compute, recursive), 0.02) << scheme;
    EXPECT_GT(meanDifference(compute, recursive), 0.0) << scheme;
  }
}

/// HOL-11: checks by texture coordinates, against recursion in double precision. Coordinates of 16 bits move
/// the edge of a check by less than 1/1000, over some 20 of the 7,081 pixels, and normals of the second step
/// are .05 rad off: 0.016 and 0.018, as subdivision_seams.yaml derives them, in quadrature 0.024. A patch
/// that took a neighbour's coordinates beyond a seam would show checks at random on 2 of 20 rows: 0.3
/// sqrt(0.05) = 0.067. Segments of a quarter of a pixel ask for the finest levels, whose triangles are
/// smaller than checks by far. There are 480 patches of 289 vertices or more: more than a software renderer's
/// tessellation stages draw at once.
TEST_F(TablesOnGpu, EveryFormHasTextureCoordinates) {
  const glm::ivec2 size(97, 73);
  for (const std::string scheme : {"loop", "catmull_clark"}) {
    const scene::Scene scene =
        makeScene("curved/control_mesh", {{"cage", std::string("seamed_ring")}, {"scheme", scheme}});
    const Image truth = render(scene, "subdivision/recursive", {{"level", int64_t{5}}}, size).product;
    const auto error = [&](Given given) {
      given["level"] = int64_t{5}, given["normals"] = std::string("second");
      const Image found = render(scene, "subdivision/tables", given, size).product;
      double sum = 0.0;
      for (size_t i = 0; i < found.pixels(); ++i)
        for (size_t c = 0; c < 3; ++c)
          sum += std::pow(double(found.data[4 * i + c]) - truth.data[4 * i + c], 2.0) / 3.0;
      return std::sqrt(sum / double(found.pixels()));
    };
    EXPECT_LT(error({{"form", std::string("instanced")}}), 0.024) << scheme;
    EXPECT_LT(error({{"form", std::string("tessellation_stages")}}), 0.024) << scheme;
    for (const bool morph : {false, true})
      for (const char* raster : {"hardware", "compute"})
        EXPECT_LT(error({{"refinement", std::string("edges")},
                         {"refinement.segment_px", 0.25},
                         {"refinement.morph", morph},
                         {"raster", std::string(raster)}}),
                  0.024)
            << scheme << " " << morph << " " << raster;
  }
}

}  // namespace
}  // namespace limen::techniques
