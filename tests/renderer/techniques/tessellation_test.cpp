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

// SC-64: evaluated in the pixel shader and copied, vertices are those of CudaTess, and so are the pixels but
// for those on edges where shaders round differently: of 12,288 at most a few at colours 1 apart.
TEST_F(Tessellation, PixelEvaluationShowsWhatComputeShows) {
  for (const char* name : {"curved/teapot", "curved/double_torus"}) {
    const scene::Scene scene = makeScene(name);
    const Rendered compute =
        render(scene, "tessellation/compute", {{"raster", std::string("hardware")}}, {128, 96}, true);
    for (const char* draw : {"instanced", "immediate"}) {
      const Rendered made = render(scene, "tessellation/patterns",
                                   {{"patterns", std::string("integer")},
                                    {"draw", std::string(draw)},
                                    {"evaluation", std::string("pixel")},
                                    {"passes", int64_t{2}}},
                                   {128, 96}, true);
      EXPECT_EQ(made.counter("patches_left_out"), 0) << name;
      EXPECT_EQ(made.counter("tessellated_triangles"), compute.counter("tessellated_triangles")) << name;
      EXPECT_LT(meanDifference(made.product, compute.product), 5.0 / 12288) << name << ' ' << draw;
    }
  }
}

}  // namespace
}  // namespace limen::techniques
