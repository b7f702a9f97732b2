// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstring>

#include "renderer/frame/shaded.h"
#include "renderer/surfaces/bezier.h"
#include "renderer/surfaces/factors.h"
#include "renderer/surfaces/other_patterns.h"
#include "renderer/surfaces/surface_errors.h"
#include "renderer/techniques/tessellation/surface_view.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

class Tessellation : public TechniqueTest {};

TEST_F(Tessellation, UniformFactorsMakeTheVerticesAndIndicesOfTheClosedForm) {
  const scene::Scene teapot = makeScene("curved/teapot");
  for (const char* form : {"vertex_parallel", "patch_parallel"}) {
    const Rendered made = render(teapot, "tessellation/compute",
                                 {{"factors", std::string("uniform")},
                                  {"factors.segments", int64_t{5}},
                                  {"cull", false},
                                  {"form", std::string(form)},
                                  {"raster", std::string("hardware")}},
                                 {64, 48}, true);
    EXPECT_EQ(made.counter("tessellated_vertices"), 32 * 36);
    EXPECT_EQ(made.counter("tessellated_triangles"), 32 * 50);
    EXPECT_EQ(made.counter("tessellated_indices"), 32 * 5 * 13);
    EXPECT_EQ(made.counter("patches_left_out"), 0);
    EXPECT_EQ(made.counter("normals_none"), 0);
  }
}

TEST_F(Tessellation, ShowsWhatTheSceneShowsAsAMesh) {
  // The same factor as the scene's own mesh.
  const scene::Scene teapot = makeScene("curved/teapot", {{"tessellation", int64_t{16}}});
  const frame::GpuScene gpuScene(teapot);
  frame::Frame frame(context(), teapot, gpuScene, {160, 120});
  frame.begin();
  const Image mesh = frame.get<frame::Shaded>(frame::ShadedSetting{}).texture().read();
  frame.end();
  const Rendered made =
      render(teapot, "tessellation/compute",
             {{"factors", std::string("uniform")}, {"factors.segments", int64_t{16}}}, {160, 120});
  // Diagonals may run the other way, and silhouettes may take another pixel.
  EXPECT_LT(meanDifference(mesh, made.product), 2e-3);
}

// Uniform factors: the tessellator's pattern has the same vertices, and as many triangles.
TEST_F(Tessellation, HardwareShowsWhatComputeShows) {
  const scene::Scene teapot = makeScene("curved/teapot");
  for (const int64_t segments : {1, 7, 64}) {
    const Given given = {
        {"factors", std::string("uniform")}, {"factors.segments", segments}, {"cull", false}};
    const Rendered compute = render(teapot, "tessellation/compute", given, {128, 96}, true);
    const Rendered hardware = render(teapot, "tessellation/hardware", given, {128, 96}, true);
    // A single quad has one of two diagonals, and the tessellator takes its own.
    if (segments > 1) {
      EXPECT_LT(meanDifference(compute.product, hardware.product), 1e-3) << segments;
    }
    EXPECT_EQ(compute.counter("tessellated_triangles"), hardware.counter("tessellated_triangles"))
        << segments;
  }
}

TEST_F(Tessellation, FractionalSpacingShowsTheSurfaceAsWell) {
  const scene::Scene teapot = makeScene("curved/teapot");
  const Rendered fine = render(teapot, "tessellation/uniform_fine", {}, {128, 96});
  for (const char* spacing : {"equal", "fractional_even", "fractional_odd"}) {
    const Rendered made =
        render(teapot, "tessellation/hardware",
               {{"spacing", std::string(spacing)}, {"factors.tolerance_px", 0.1}}, {128, 96});
    EXPECT_LT(meanDifference(fine.product, made.product), 2e-3) << spacing;
  }
}

TEST_F(Tessellation, TheComputeRasterShowsWhatTheDriversShows) {
  for (const char* name : {"curved/teapot", "curved/sheet"}) {
    const scene::Scene scene = makeScene(name);
    const Rendered driver =
        render(scene, "tessellation/compute", {{"raster", std::string("hardware")}}, {128, 96}, true);
    const Rendered compute =
        render(scene, "tessellation/compute", {{"raster", std::string("compute")}}, {128, 96}, true);
    EXPECT_LT(meanDifference(driver.product, compute.product), 1e-4) << name;
    EXPECT_EQ(driver.counter("tessellated_triangles"), compute.counter("tessellated_triangles")) << name;
    EXPECT_EQ(compute.counter("tessellated_indices"), 3 * compute.counter("tessellated_triangles")) << name;
  }
}

TEST_F(Tessellation, TheSurfaceReadBackIsExactAndTheSameTwice) {
  const scene::Scene scene = makeScene("curved/sheet", {{"turned", true}, {"relief", 2.0}});
  const frame::GpuScene gpuScene(scene);
  frame::Frame frame(context(), scene, gpuScene, {160, 120});
  const TechniqueInfo& info = TechniqueRegistry::instance().get("tessellation/compute");
  const auto technique = info.make(ParameterValues(info.parameters, {}));
  technique->prepare(frame);
  const auto rendered = [&] {
    frame.begin();
    technique->render(frame);
    frame.end();
    return technique->tessellation(frame);
  };
  const auto first = rendered(), second = rendered();
  ASSERT_GT(first->positions.size(), 1000U);
  ASSERT_EQ(first->positions.size(), second->positions.size());
  EXPECT_EQ(std::memcmp(first->positions.data(), second->positions.data(), first->positions.size() * 12), 0);
  EXPECT_EQ(std::memcmp(first->normals.data(), second->normals.data(), first->normals.size() * 12), 0);
  EXPECT_EQ(first->triangles, second->triangles);
  double most = 0.0;
  for (size_t i = 0; i < first->positions.size(); ++i) {
    const surfaces::Patch& patch = scene.surfaces.patches[first->patches[i]];
    const glm::dvec3 exact =
        surfaces::evaluate(scene.surfaces, patch, first->parameters[i], surfaces::Order::Position).p;
    most = std::max(most, glm::length(first->anchor + glm::dvec3(first->positions[i]) - exact));
  }
  EXPECT_LT(most, 1e-6 * gpuScene.diagonal());
}

// The shader's factors in float are those of factors.h in double, but for patches whose number of segments
// lies within rounding of a whole one.
TEST_F(Tessellation, FactorsAreThoseOfTheBoundsInDoublePrecision) {
  for (const std::string space : {"lighting", "object"}) {
    const scene::Scene scene = makeScene("curved/sheet", {{"relief", 2.0}});
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, {320, 240});
    const TechniqueInfo& info = TechniqueRegistry::instance().get("tessellation/compute");
    const auto technique = info.make(
        ParameterValues(info.parameters, {{"factors", std::string("deviation")}, {"factors.space", space}}));
    technique->prepare(frame);
    frame.begin();
    technique->render(frame);
    frame.end();
    const auto surface = technique->tessellation(frame);
    const surfaces::PatchSet& set = scene.surfaces;
    std::vector<glm::dvec2> segments;
    for (const surfaces::Patch& patch : set.patches) {
      double depth = 1e300;
      for (uint32_t i = 0; i < 16; ++i)
        depth = std::min(depth, glm::dot(glm::dvec3(set.points[patch.firstPoint + i]) - surface->view.eye,
                                         surface->view.forward));
      if (space == "object") depth = glm::dot(gpuScene.anchor() - surface->view.eye, surface->view.forward);
      const double eps = surfaces::objectTolerance(0.5, depth, frame.tanHalfFov(), 240);
      segments.push_back(surfaces::segmentsOf(surfaces::derivativeBounds(set, patch, eps), eps,
                                              surfaces::FactorRule::AbiEzziShirman));
    }
    int compared = 0;
    for (size_t i = 0; i < set.patches.size(); ++i) {
      if (surface->factors[i][0] == 0) continue;
      for (size_t side = 0; side < 4; ++side) {
        const surfaces::Neighbour& beyond = set.neighbours[i][side];
        double own = side % 2 == 0 ? segments[i].x : segments[i].y;
        if (beyond.patch >= 0 && surface->factors[size_t(beyond.patch)][0] > 0)
          own = std::max(own, beyond.side % 2 == 0 ? segments[size_t(beyond.patch)].x
                                                   : segments[size_t(beyond.patch)].y);
        if (std::abs(own - std::round(own)) < 1e-4) continue;
        EXPECT_EQ(surface->factors[i][side], surfaces::wholeFactor(own, 64))
            << space << " patch " << i << " side " << side;
        ++compared;
      }
    }
    EXPECT_GT(compared, 500) << space;
  }
}

// Those whose factor, in double precision and without a limit, is above the limit.
TEST_F(Tessellation, PatchesThatNeedMoreSegmentsThanAllowedAreCounted) {
  const scene::Scene torus = makeScene("curved/double_torus");
  const auto segmentsFor = [&](int64_t most) {
    Given given = {{"factors", std::string("deviation")},
                   {"factors.tolerance_px", 0.1},
                   {"factors.triangle_rule", std::string("pn_safe")},
                   {"factors.most", most},
                   {"cull", false}};
    return given;
  };
  const frame::GpuScene gpuScene(torus);
  frame::Frame frame(context(), torus, gpuScene, {320, 240});
  const TechniqueInfo& info = TechniqueRegistry::instance().get("tessellation/compute");
  const auto capped = [&](int64_t most) {
    const auto technique = info.make(ParameterValues(info.parameters, segmentsFor(most)));
    technique->prepare(frame);
    frame.begin();
    technique->render(frame);
    frame.end();
    for (const Counter& counter : technique->count(frame))
      if (counter.name == "patches_capped") return counter.value;
    return -1.0;
  };
  EXPECT_EQ(capped(64), 0);
  // One factor for all sides of a triangle.
  std::vector<double> needed;
  const surfaces::PatchSet& set = torus.surfaces;
  const surfaces::SurfaceView view = viewOf(frame);
  for (const surfaces::Patch& patch : set.patches) {
    double depth = 1e300;
    for (uint32_t i = 0; i < 10; ++i)
      depth =
          std::min(depth, glm::dot(glm::dvec3(set.points[patch.firstPoint + i]) - view.eye, view.forward));
    const double eps = surfaces::objectTolerance(0.1, depth, frame.tanHalfFov(), 240);
    needed.push_back(std::sqrt(surfaces::constantOf(surfaces::PnBound::Safe) *
                               surfaces::largestTangentDistance(set, patch) / eps));
  }
  std::vector<double> sorted = needed;
  std::sort(sorted.begin(), sorted.end());
  for (const size_t quarter : {1, 2, 3}) {
    const int most = static_cast<int>(sorted[quarter * sorted.size() / 4]);
    const auto more = [&](double by) {
      return double(std::count_if(needed.begin(), needed.end(), [&](double n) { return n > most + by; }));
    };
    EXPECT_GT(more(0.0), 20) << most;
    EXPECT_LT(more(0.0), double(needed.size())) << most;
    // Between those that are out of rounding's reach.
    EXPECT_GE(capped(most), more(1e-4)) << most;
    EXPECT_LE(capped(most), more(-1e-4)) << most;
  }
}

TEST_F(Tessellation, PatchesThatDoNotFitAreLeftOutAndCounted) {
  const scene::Scene teapot = makeScene("curved/teapot");
  // 36 vertices a patch: 10 fit into 390.
  const Rendered made = render(teapot, "tessellation/compute",
                               {{"factors", std::string("uniform")},
                                {"factors.segments", int64_t{5}},
                                {"cull", false},
                                {"capacity", int64_t{390}}},
                               {64, 48}, true);
  EXPECT_EQ(made.counter("patches_left_out"), 22);
  EXPECT_EQ(made.counter("tessellated_vertices"), 360);
}

/// 32,000 patches at half a pixel take more than a million vertices.
TEST_F(Tessellation, BuffersHoldWhatTheFirstViewTakes) {
  const Rendered made =
      render(makeScene("curved/spheres"), "tessellation/compute",
             {{"factors", std::string("deviation")}, {"factors.tolerance_px", 0.25}}, {256, 192}, true);
  EXPECT_EQ(made.counter("patches_left_out"), 0);
  EXPECT_GT(made.counter("tessellated_vertices"), 900000);
}

/// 92,256 patches: the default of 64 segments would be 390 million vertices.
TEST_F(Tessellation, AReferenceThatNoBufferHoldsIsRefused) {
  const scene::Scene scene = makeScene("curved/herd");
  try {
    render(scene, "tessellation/uniform_fine", {}, {16, 12});
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("use at most 25"), std::string::npos) << error.what();
  }
}

TEST_F(Tessellation, BothFormsAndBothScansMakeTheSamePicture) {
  const scene::Scene teapot = makeScene("curved/teapot");
  const Rendered first = render(teapot, "tessellation/compute", {}, {96, 72});
  for (const char* form : {"vertex_parallel", "patch_parallel"})
    for (const char* scan : {"look_back", "reduce_then_scan"}) {
      const Rendered made = render(teapot, "tessellation/compute",
                                   {{"form", std::string(form)}, {"scan", std::string(scan)}}, {96, 72});
      EXPECT_EQ(meanDifference(first.product, made.product), 0.0) << form << " " << scan;
    }
}

/// The same triangles as in compute, by stored patterns, whoever builds the batches.
TEST_F(Tessellation, PatternsShowWhatComputeShows) {
  for (const char* name : {"curved/teapot", "curved/double_torus"}) {
    const scene::Scene scene = makeScene(name);
    for (const char* patterns : {"integer", "dyadic"}) {
      const bool dyadic = std::string(patterns) == "dyadic";
      const Rendered compute = render(scene, "tessellation/compute",
                                      {{"raster", std::string("hardware")},
                                       {"spacing", std::string(patterns)},
                                       {"factors.most", int64_t{16}}},
                                      {96, 72}, true);
      for (const char* draw : {"immediate", "instanced", "multi_draw"}) {
        if (!dyadic && std::string(draw) == "multi_draw") continue;
        const Rendered made = render(
            scene, "tessellation/patterns",
            {{"patterns", std::string(patterns)}, {"draw", std::string(draw)}, {"factors.most", int64_t{16}}},
            {96, 72}, true);
        EXPECT_LT(meanDifference(compute.product, made.product), 1e-6)
            << name << " " << patterns << " " << draw;
        EXPECT_EQ(compute.counter("tessellated_triangles"), made.counter("tessellated_triangles"))
            << name << " " << patterns << " " << draw;
        EXPECT_EQ(made.counter("patches_left_out"), 0);
      }
    }
  }
}

/// Uniform patterns with samples on sides moved: more triangles, some without area, and no gaps.
TEST_F(Tessellation, AdaptedUniformPatternsShowTheSurface) {
  const scene::Scene teapot = makeScene("curved/teapot");
  const Rendered fine = render(teapot, "tessellation/uniform_fine", {}, {128, 96});
  const Rendered exact =
      render(teapot, "tessellation/patterns", {{"patterns", std::string("integer")}}, {128, 96}, true);
  for (const char* patterns : {"adapted", "adapted_integer"})
    for (const char* draw : {"immediate", "instanced", "multi_draw"}) {
      if (std::string(patterns) == "adapted_integer" && std::string(draw) == "multi_draw") continue;
      const Rendered made =
          render(teapot, "tessellation/patterns",
                 {{"patterns", std::string(patterns)}, {"draw", std::string(draw)}}, {128, 96}, true);
      EXPECT_LT(meanDifference(fine.product, made.product), 3e-3) << patterns << " " << draw;
      EXPECT_GT(made.counter("tessellated_triangles"), exact.counter("tessellated_triangles")) << patterns;
    }
}

/// On a closed surface strips close every gap: no pixel far from the fine surface's colour is left.
TEST_F(Tessellation, StripsCloseTheGapsBetweenLevels) {
  const scene::Scene torus = makeScene("curved/double_torus");
  const Image fine =
      render(torus, "tessellation/uniform_fine", {{"segments", int64_t{16}}}, {320, 240}).product;
  const auto wrongPixels = [&](const Image& image) {
    int wrong = 0;
    for (int y = 1; y + 1 < image.height; ++y)
      for (int x = 1; x + 1 < image.width; ++x) {
        // Nearest of the pixels around: silhouettes may move by one.
        double nearest = 1e9;
        for (int b = y - 1; b <= y + 1; ++b)
          for (int a = x - 1; a <= x + 1; ++a) {
            double difference = 0.0;
            for (int c = 0; c < 3; ++c) difference += std::abs(double(image.at(x, y, c)) - fine.at(a, b, c));
            nearest = std::min(nearest, difference);
          }
        wrong += nearest > 0.1;
      }
    return wrong;
  };
  // A tolerance of 4 px makes gaps wide enough to be seen. Silhouettes of so coarse a surface lie elsewhere
  // too: no more than those of one that has no gaps in the first place.
  const Given coarse = {{"factors", std::string("deviation")}, {"factors.tolerance_px", 4.0}};
  Given whole = coarse;
  whole.emplace("spacing", std::string("dyadic"));
  const int elsewhere = wrongPixels(render(torus, "tessellation/compute", whole, {320, 240}).product);
  for (const bool batched : {true, false}) {
    Given given = coarse;
    given.emplace("batched", batched);
    const Rendered closed = render(torus, "tessellation/connected_patterns", given, {320, 240}, true);
    given.emplace("strips", false);
    const Rendered gaps = render(torus, "tessellation/connected_patterns", given, {320, 240}, true);
    EXPECT_GT(closed.counter("sides_stitched"), 20);
    EXPECT_GT(closed.counter("strip_triangles"), 2 * closed.counter("sides_stitched"));
    EXPECT_EQ(gaps.counter("strip_triangles"), 0);
    EXPECT_EQ(closed.counter("crack_pixels"), 0);
    EXPECT_GT(gaps.counter("crack_pixels"), 0);
    EXPECT_GT(wrongPixels(gaps.product), wrongPixels(closed.product));
    // Borders widen silhouettes, so away from these, where the fine picture changes little.
    const auto wrongInside = [&](const Image& image) {
      int wrong = 0;
      for (int y = 3; y + 3 < image.height; ++y)
        for (int x = 3; x + 3 < image.width; ++x) {
          double low = 1e9, high = -1e9;
          for (int b = y - 3; b <= y + 3; ++b)
            for (int a = x - 3; a <= x + 3; ++a)
              low = std::min(low, double(fine.at(a, b, 0))), high = std::max(high, double(fine.at(a, b, 0)));
          wrong += high - low < 0.1 && std::abs(double(image.at(x, y, 0)) - fine.at(x, y, 0)) > 0.1;
        }
      return wrong;
    };
    given.emplace("border_px", 1.5);
    const Rendered hidden = render(torus, "tessellation/connected_patterns", given, {320, 240}, true);
    EXPECT_GT(hidden.counter("border_triangles"), 0);
    EXPECT_GT(wrongInside(gaps.product), 3);
    EXPECT_LT(wrongInside(hidden.product), wrongInside(gaps.product));
    EXPECT_LE(wrongPixels(closed.product), elsewhere);
  }
}

/// A drum whose lids end in straight lines and whose side in arcs: strips fill the lids up to the arcs, with
/// the lids' normals, at all levels and pairs of them.
TEST_F(Tessellation, StripsCloseTheGapsAtCreases) {
  const scene::Scene drum = makeScene("curved/hard_case", {{"case", std::string("drum")}});
  for (const double tolerance : {0.1, 0.5, 1.0, 4.0}) {
    Given given = {{"factors", std::string("deviation")}, {"factors.tolerance_px", tolerance}};
    const Rendered closed = render(drum, "tessellation/connected_patterns", given, {320, 240}, true);
    given["close_gaps"] = false;
    const Rendered open = render(drum, "tessellation/connected_patterns", given, {320, 240}, true);
    EXPECT_GT(open.counter("crack_pixels"), 500);
    EXPECT_EQ(open.counter("gaps_closed"), 0);
    EXPECT_EQ(closed.counter("crack_pixels"), 0) << tolerance;
    EXPECT_EQ(closed.counter("gaps_closed"), 24);
  }
}

/// The lid of a drum is flat: its colour changes slowly up to the rim, as it does not where strips take the
/// side's normals or are not there.
TEST_F(Tessellation, StripsAtCreasesTakeTheNormalsOfTheFaceThatTheyContinue) {
  // From above, so that the lid fills the picture's middle; its radius is 0.6.
  const scene::Scene drum =
      makeScene("curved/hard_case", {{"case", std::string("drum")},
                                     {"camera", std::string("view")},
                                     {"camera.text", std::string("eye 0 3.9 0.001 target 0 0.9 0 fov 40")}});
  const glm::ivec2 size(240, 240);
  const Rendered closed = render(drum, "tessellation/connected_patterns", {}, size, true);
  const Rendered open = render(drum, "tessellation/connected_patterns", {{"close_gaps", false}}, size, true);
  const double radiusPx = 120.0 * 0.6 / (3.0 * std::tan(glm::radians(20.0)));
  // Those of a circle that an inscribed polygon of 12 sides lacks.
  const auto othersIn = [&](const Image& image, double radius) {
    int out = 0;
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) {
        if (glm::length(glm::dvec2(x - 119.5, y - 119.5)) > radius) continue;
        // A tenth of the way towards the middle.
        const auto inwards = [](int at) { return int(std::lround(119.5 + 0.9 * (at - 119.5))); };
        double difference = 0.0;
        for (int c = 0; c < 3; ++c)
          difference += std::abs(double(image.at(x, y, c)) - image.at(inwards(x), inwards(y), c));
        out += difference > 0.05;
      }
    return out;
  };
  EXPECT_GT(othersIn(open.product, radiusPx - 1.5), 50);
  EXPECT_EQ(othersIn(closed.product, radiusPx - 1.5), 0);
  EXPECT_EQ(othersIn(open.product, 0.95 * radiusPx), 0);
}

/// The surface that a technique makes in one frame.
class TessellatedSurfaces : public Tessellation {
 protected:
  std::shared_ptr<const surfaces::TessellatedSurface> made(const scene::Scene& scene, const Given& given,
                                                           const std::string& name = "tessellation/compute") {
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, {160, 120});
    const TechniqueInfo& info = TechniqueRegistry::instance().get(name);
    const auto technique = info.make(ParameterValues(info.parameters, given));
    technique->prepare(frame);
    frame.begin();
    technique->render(frame);
    frame.end();
    return technique->tessellation(frame);
  }
  /// From the surface at the same parameters.
  static double largestError(const scene::Scene& scene, const surfaces::TessellatedSurface& surface) {
    double most = 0.0;
    for (size_t i = 0; i < surface.positions.size(); ++i) {
      const surfaces::Patch& patch = scene.surfaces.patches[surface.patches[i]];
      const glm::dvec3 exact =
          surfaces::evaluate(scene.surfaces, patch, surface.parameters[i], surfaces::Order::Position).p;
      most = std::max(most, glm::length(surface.anchor + glm::dvec3(surface.positions[i]) - exact));
    }
    return most;
  }
  static void expectNoCracks(const scene::Scene& scene, const surfaces::TessellatedSurface& surface,
                             const std::string& what) {
    const surfaces::Cracks cracks = surfaces::cracksOf(scene.surfaces, surface);
    EXPECT_GT(cracks.sides, 20) << what;
    EXPECT_EQ(cracks.unequalVertices, 0) << what;
    EXPECT_EQ(cracks.loneVertices, 0) << what;
    EXPECT_EQ(cracks.openEdges, 0) << what;
    EXPECT_EQ(cracks.foldOvers, 0) << what;
  }
  static Given text(std::initializer_list<std::pair<std::string, std::string>> values) {
    Given out;
    for (const auto& [name, value] : values) out.emplace(name, value);
    return out;
  }
};

/// All ways to evaluate, against double precision (1e-5 of the extent, 1 and 4) and without cracks.
TEST_F(TessellatedSurfaces, AllFormsOfEvaluationAreExactAndWithoutCracks) {
  const std::array<scene::Scene, 2> scenes = {makeScene("curved/sheet", {{"turned", true}, {"relief", 2.0}}),
                                              makeScene("curved/teapot")};
  for (const scene::Scene& scene : scenes)
    for (const std::string form : {"patch_parallel", "four_threads"})
      for (const std::string evaluation : {"direct", "forward_differences"})
        for (const std::string sides : {"evaluated", "copied"}) {
          const auto surface =
              made(scene, text({{"form", form}, {"evaluation", evaluation}, {"sides", sides}}));
          const std::string what = form + " " + evaluation + " " + sides;
          ASSERT_GT(surface->positions.size(), 1000U) << what;
          EXPECT_LT(largestError(scene, *surface), 1e-5) << what;
          EXPECT_LT(surfaces::normalErrors(scene.surfaces, *surface).p99, 0.1) << what;
          expectNoCracks(scene, *surface, what);
        }
}

/// Normal fields of rectangles, in float as in double precision, whichever shader evaluates them.
TEST_F(TessellatedSurfaces, RectanglesHaveTheirOwnNormals) {
  const scene::Scene scene = makeScene(
      "curved/subdivision", {{"approximation", std::string("acc_tangents")}, {"steps", int64_t{0}}});
  for (const std::string form : {"vertex_parallel", "patch_parallel", "four_threads"}) {
    const auto surface = made(scene, text({{"form", form}}));
    EXPECT_LT(surfaces::normalErrors(scene.surfaces, *surface).most, 0.01) << form;
  }
  // The geometry's are others.
  const scene::Scene plain = makeScene("curved/subdivision", {{"steps", int64_t{0}}});
  EXPECT_GT(surfaces::normalErrors(plain.surfaces, *made(scene, {})).most, 1.0);
}

TEST_F(TessellatedSurfaces, FourThreadsGiveTheBitsOfOthers) {
  const scene::Scene scene = makeScene("curved/teapot");
  const auto one = made(scene, {}), four = made(scene, text({{"form", "four_threads"}}));
  ASSERT_EQ(one->positions.size(), four->positions.size());
  EXPECT_EQ(std::memcmp(one->positions.data(), four->positions.data(), one->positions.size() * 12), 0);
}

/// However many invocations share a patch: vertices and triangles bit for bit, whether sides are divided
/// alike or not, and for triangles as well.
TEST_F(TessellatedSurfaces, InvocationsThatShareAPatchMakeTheSameOfIt) {
  const std::array<scene::Scene, 3> scenes = {makeScene("curved/sheet", {{"turned", true}, {"relief", 2.0}}),
                                              makeScene("curved/teapot"), makeScene("curved/double_torus")};
  for (const scene::Scene& scene : scenes)
    for (const std::string raster : {"hardware", "compute"}) {
      const auto first = made(scene, text({{"form", "vertex_parallel"}, {"raster", raster}}));
      ASSERT_GT(first->positions.size(), 1000U);
      for (const int64_t lanes : {0, 4, 8, 32, 64, 256, 1024}) {
        Given given = text({{"form", "patch_parallel"}, {"raster", raster}});
        given.emplace("form.lanes", lanes);
        const auto other = made(scene, given);
        ASSERT_EQ(first->positions.size(), other->positions.size()) << raster << lanes;
        EXPECT_EQ(std::memcmp(first->positions.data(), other->positions.data(), first->positions.size() * 12),
                  0)
            << raster << lanes;
        EXPECT_EQ(std::memcmp(first->normals.data(), other->normals.data(), first->normals.size() * 12), 0)
            << raster << lanes;
        EXPECT_EQ(first->triangles, other->triangles) << raster << lanes;
      }
    }
}

/// The vertex shader makes each vertex from a stored patch and sample (SC-76): on the surface, without
/// cracks, and the picture of vertices stored.
TEST_F(TessellatedSurfaces, TheVertexShaderEvaluatesStoredSamples) {
  const std::array<scene::Scene, 3> scenes = {makeScene("curved/sheet", {{"turned", true}, {"relief", 2.0}}),
                                              makeScene("curved/teapot"), makeScene("curved/double_torus")};
  for (const scene::Scene& scene : scenes)
    for (const std::string form : {"patch_parallel", "vertex_parallel"}) {
      const Given given = text({{"form", form}, {"evaluation", "vertex_shader"}});
      const auto surface = made(scene, given);
      ASSERT_GT(surface->positions.size(), 1000U) << form;
      EXPECT_LT(largestError(scene, *surface), 1e-5) << form;
      EXPECT_LT(surfaces::normalErrors(scene.surfaces, *surface).p99, 0.1) << form;
      expectNoCracks(scene, *surface, form);
      // The driver rasterises what vertex shaders make.
      const Image stored =
          render(scene, "tessellation/compute", text({{"raster", "hardware"}}), {96, 72}).product;
      EXPECT_LT(meanDifference(stored, render(scene, "tessellation/compute", given, {96, 72}).product), 1e-6)
          << form;
    }
}

/// Passes beside the one that is shown change no picture, whatever they draw (SC-75); neither does a coarse
/// mesh drawn first (SC-64). Triangles stored by transform feedback take three vertices each.
TEST_F(Tessellation, SeveralPassesShowWhatOneDoes) {
  const scene::Scene scene = makeScene("curved/double_torus");
  const auto whole = [](const char* name, int64_t value) {
    return std::pair<std::string, ParameterValue>(name, value);
  };
  const Rendered one =
      render(scene, "tessellation/patterns", {{"patterns", std::string("integer")}}, {96, 72}, true);
  const Rendered compute = render(scene, "tessellation/compute",
                                  {{"raster", std::string("hardware")}, whole("passes", 3)}, {96, 72}, true);
  EXPECT_LT(meanDifference(one.product, compute.product), 1e-6);
  for (const int64_t passes : {1, 2, 5})
    for (const char* reuse : {"evaluate", "soup"})
      for (const bool coarseFirst : {false, true}) {
        if (coarseFirst && std::string(reuse) == "soup") continue;
        const Rendered made = render(scene, "tessellation/patterns",
                                     {{"patterns", std::string("integer")},
                                      {"reuse", std::string(reuse)},
                                      {"coarse_first", coarseFirst},
                                      whole("passes", passes)},
                                     {96, 72}, true);
        EXPECT_LT(meanDifference(one.product, made.product), 1e-6) << passes << reuse << coarseFirst;
        EXPECT_EQ(made.counter("soup_left_out"), 0);
        EXPECT_NEAR(
            made.counter("soup_mib"),
            std::string(reuse) == "soup" ? compute.counter("tessellated_triangles") * 96 / 1048576.0 : 0.0,
            1e-9);
      }
}

/// Spacings of real factors, with sides that run in all combinations of directions.
TEST_F(TessellatedSurfaces, AllSpacingsAreWithoutCracks) {
  const scene::Scene scene = makeScene("curved/sheet", {{"turned", true}, {"relief", 2.0}});
  for (const std::string spacing : {"dyadic", "fractional_even", "fractional_odd", "moreton", "geomorph"}) {
    const auto surface = made(scene, text({{"spacing", spacing}}));
    ASSERT_GT(surface->positions.size(), 1000U) << spacing;
    expectNoCracks(scene, *surface, spacing);
    if (spacing != "geomorph") {
      EXPECT_LT(largestError(scene, *surface), 1e-6 * 2.0) << spacing;
    }
  }
}

/// Segments no longer than 1 / factor, or levels mixed as morphShare() does, keep the tolerance.
TEST_F(TessellatedSurfaces, SpacingsWithoutLongerSegmentsKeepTheTolerance) {
  const scene::Scene scene = makeScene("curved/sheet", {{"relief", 2.0}});
  for (const std::string spacing : {"integer", "dyadic", "moreton", "geomorph"}) {
    const auto surface = made(scene, text({{"spacing", spacing}}));
    EXPECT_LT(surfaces::deviationOf(scene.surfaces, *surface).atParametersPx.most, 0.5) << spacing;
  }
}

/// On the screen: triangles of projected vertices against the projected surface at equal parameters, in
/// double precision. Patches seen edge-on need fewer segments there than in eye coordinates.
TEST_F(TessellatedSurfaces, BoundsOnTheScreenHoldThere) {
  for (const char* name : {"curved/sheet", "curved/teapot"}) {
    const scene::Scene scene = makeScene(name);
    Given given = text({{"factors", "deviation"}, {"factors.space", "screen"}});
    const auto surface = made(scene, given);
    ASSERT_GT(surface->triangles.size(), 1000U);
    const surfaces::SurfaceView& view = surface->view;
    const auto seen = [&](const glm::dvec3& p) {
      const glm::dvec3 d = p - view.eye;
      const double depth = glm::dot(d, view.forward);
      return glm::dvec3(glm::dot(d, view.right) / depth, glm::dot(d, view.up) / depth, depth);
    };
    double most = 0.0;
    int samples = 0;
    for (const glm::uvec3& t : surface->triangles) {
      if (surface->patches[t.x] != surface->patches[t.y] || surface->patches[t.x] != surface->patches[t.z])
        continue;
      const surfaces::Patch& patch = scene.surfaces.patches[surface->patches[t.x]];
      std::array<glm::dvec3, 3> corners;
      bool behind = false;
      for (int k = 0; k < 3; ++k) {
        corners[size_t(k)] = seen(surface->anchor + glm::dvec3(surface->positions[t[k]]));
        behind = behind || corners[size_t(k)].z < view.nearest;
      }
      if (behind) continue;
      for (const glm::dvec3 w : {glm::dvec3(1, 1, 1) / 3.0, glm::dvec3(0.5, 0.5, 0), glm::dvec3(0, 0.5, 0.5),
                                 glm::dvec3(0.5, 0, 0.5)}) {
        const auto &a = surface->parameters[t.x], &b = surface->parameters[t.y],
                   &c = surface->parameters[t.z];
        const auto at =
            surfaces::rectanglePoint(w.x * a.u + w.y * b.u + w.z * c.u, w.x * a.v + w.y * b.v + w.z * c.v);
        const glm::dvec3 exact =
            seen(surfaces::evaluate(scene.surfaces, patch, at, surfaces::Order::Position).p);
        const glm::dvec3 flat = w.x * corners[0] + w.y * corners[1] + w.z * corners[2];
        most = std::max(most, glm::length(glm::dvec2(exact - flat)) * view.pxAtDistance);
        ++samples;
      }
    }
    EXPECT_GT(samples, 4000) << name;
    EXPECT_LT(most, 0.5 + 1e-3) << name;
    EXPECT_GT(most, 0.05) << name;
    EXPECT_LT(surface->triangles.size(), made(scene, {})->triangles.size()) << name;
  }
  EXPECT_THROW(
      made(makeScene("curved/double_torus"), text({{"factors", "deviation"}, {"factors.space", "screen"}})),
      Error);
}

TEST_F(TessellatedSurfaces, BoundsMadeOnceKeepTheToleranceToo) {
  const scene::Scene scene = makeScene("curved/teapot");
  const auto every = made(scene, {}), once = made(scene, {{"precompute", true}});
  EXPECT_LT(surfaces::deviationOf(scene.surfaces, *once).atParametersPx.most, 0.5);
  // A box is nearer to the eye than its points: more segments, if few.
  EXPECT_GE(once->positions.size(), every->positions.size());
  EXPECT_LT(double(once->positions.size()), 1.3 * double(every->positions.size()));
}

/// The generator of concentric patterns against the driver's own tessellator, for all factors of two scenes.
TEST_F(TessellatedSurfaces, TheDriversTessellatorMakesConcentricPatterns) {
  for (const char* name : {"curved/double_torus", "curved/sheet"}) {
    const scene::Scene scene = makeScene(name);
    const auto surface = made(scene, {});
    size_t expected = 0;
    for (size_t i = 0; i < surface->factors.size(); ++i) {
      const surfaces::Factors& f = surface->factors[i];
      if (f[0] == 0) continue;
      const surfaces::Domain domain = scene.surfaces.patches[i].domain;
      const glm::ivec2 inner = domain == surfaces::Domain::Rectangle
                                   ? glm::ivec2(std::min(f[0], f[2]), std::min(f[1], f[3]))
                                   : glm::ivec2(std::max({f[0], f[1], f[2]}));
      expected += surfaces::concentricPattern(domain, f, inner).triangles.size();
    }
    const Rendered driver = render(scene, "tessellation/hardware", {}, {160, 120}, true);
    EXPECT_GT(expected, 1000U) << name;
    EXPECT_EQ(driver.counter("tessellated_triangles"), double(expected)) << name;
  }
}

TEST_F(TessellatedSurfaces, SettingsThatContradictEachOtherAreRefused) {
  const auto refused = [](const std::string& name, const Given& given) {
    const TechniqueInfo& info = TechniqueRegistry::instance().get(name);
    EXPECT_THROW(info.check(ParameterValues(info.parameters, given)), Error) << name;
  };
  refused("tessellation/compute", text({{"form", "vertex_parallel"}, {"evaluation", "forward_differences"}}));
  refused("tessellation/compute", text({{"form", "four_threads"}, {"spacing", "geomorph"}}));
  refused("tessellation/compute", text({{"evaluation", "vertex_shader"}, {"raster", "compute"}}));
  refused("tessellation/compute", text({{"evaluation", "vertex_shader"}, {"spacing", "geomorph"}}));
  refused("tessellation/patterns", text({{"patterns", "integer"}, {"draw", "multi_draw"}}));
  refused("tessellation/patterns", {{"draw", std::string("multi_draw")}, {"coarse_first", true}});
  refused("tessellation/patterns", {{"reuse", std::string("soup")}, {"coarse_first", true}});
  // Known with the scene alone.
  EXPECT_THROW(made(makeScene("curved/double_torus"), text({{"spacing", "moreton"}})), Error);
}

/// PN triangles: bounds hold, the estimate of 9/4 asks for fewer.
TEST_F(TessellatedSurfaces, PnTrianglesKeepTheTolerance) {
  const scene::Scene scene = makeScene("curved/double_torus");
  size_t most = 0, estimated = 0;
  for (const std::string rule : {"sides", "pn_estimate", "pn_tied", "pn_safe"})
    for (const bool precompute : {false, true}) {
      Given given = text({{"factors", "deviation"}, {"factors.triangle_rule", rule}});
      given.emplace("precompute", precompute);
      given.emplace("factors.tolerance_px", 0.25);
      const auto surface = made(scene, given);
      ASSERT_GT(surface->positions.size(), 1000U) << rule;
      EXPECT_LT(largestError(scene, *surface), 1e-5) << rule;
      expectNoCracks(scene, *surface, rule);
      if (rule == "pn_estimate") {
        estimated = surface->positions.size();
      } else {
        EXPECT_LT(surfaces::deviationOf(scene.surfaces, *surface).atParametersPx.most, 0.25) << rule;
        most = std::max(most, surface->positions.size());
      }
    }
  EXPECT_LT(estimated, most);
}

TEST_F(TessellatedSurfaces, GeomorphedTrianglesAreWithoutCracks) {
  const scene::Scene scene = makeScene("curved/double_torus");
  const auto surface = made(scene, text({{"spacing", "geomorph"}}));
  expectNoCracks(scene, *surface, "geomorph");
  EXPECT_LT(surfaces::deviationOf(scene.surfaces, *surface).atParametersPx.most, 0.5);
}

}  // namespace
}  // namespace limen::techniques
