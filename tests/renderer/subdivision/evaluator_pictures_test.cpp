// SPDX-License-Identifier: BSD-3-Clause
// Attributes, levels of edges and pictures of what the GPU makes of tables.
#include <algorithm>
#include <cstring>

#include "renderer/scene/curved/double_torus.h"
#include "renderer/scene/curved/subdivision_cages.h"
#include "renderer/surfaces/catmull_clark.h"
#include "renderer/techniques/subdivision/adaptive_mesh.h"
#include "tests/renderer/subdivision/evaluator_fixture.h"

namespace limen::techniques {
namespace {

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
