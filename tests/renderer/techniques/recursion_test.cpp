// SPDX-License-Identifier: BSD-3-Clause
#include <epoxy/gl.h>

#include <algorithm>
#include <array>

#include <cmath>

#include "renderer/surfaces/bezier.h"
#include "renderer/surfaces/tessellated_surface.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

class RecursionTechniques : public TechniqueTest {};

constexpr glm::ivec2 kSize{128, 96};

TEST_F(RecursionTechniques, ShowWhatAFineTessellationShows) {
  for (const char* name : {"curved/teapot", "curved/double_torus"}) {
    const scene::Scene scene = makeScene(name);
    const int64_t segments = std::string(name) == "curved/teapot" ? 32 : 12;
    const Rendered fine = render(scene, "tessellation/uniform_fine", {{"segments", segments}}, kSize);
    for (const char* technique : {"recursion/cpu", "recursion/queues"}) {
      const Rendered made = render(scene, technique, {{"tolerance_px", 0.1}}, kSize);
      EXPECT_LT(meanDifference(fine.product, made.product), 2e-3) << name << " " << technique;
    }
    const Rendered diced =
        render(scene, "recursion/queues",
               {{"flatness", std::string("extent")}, {"tolerance_px", 8.0}, {"grid", int64_t{16}}}, kSize);
    EXPECT_LT(meanDifference(fine.product, diced.product), 2e-3) << name;
  }
}

// The queues in float split as the recursion in double does, but for parts within rounding of the tolerance.
TEST_F(RecursionTechniques, QueuesMakeThePartsOfTheRecursionInDouble) {
  for (const char* name : {"curved/teapot", "curved/double_torus"})
    for (const char* flatness : {"control_to_chord", "control_to_corresponding", "extent"})
      for (const char* split : {"quarters", "halves"}) {
        const scene::Scene scene = makeScene(name);
        // Triangles are split at their sides on the CPU.
        if (std::string(name) == "curved/double_torus" && std::string(split) == "halves") continue;
        const Given given = {{"tolerance_px", std::string(flatness) == "extent" ? 8.0 : 0.5},
                             {"flatness", std::string(flatness)},
                             {"split", std::string(split)}};
        const Rendered cpu = render(scene, "recursion/cpu", given, kSize, true);
        Given undiced = given;
        undiced["grid"] = int64_t{1};
        const Rendered queues = render(scene, "recursion/queues", undiced, kSize, true);
        EXPECT_EQ(queues.counter("parts_left_out"), 0);
        EXPECT_GT(cpu.counter("faces"), 50);
        EXPECT_NEAR(queues.counter("faces"), cpu.counter("faces"), 2 + 0.005 * cpu.counter("faces"))
            << name << " " << flatness << " " << split;
        EXPECT_NEAR(queues.counter("parts_tested"), cpu.counter("parts_tested"),
                    2 + 0.005 * cpu.counter("parts_tested"));
        EXPECT_EQ(queues.counter("recursion_steps"), cpu.counter("recursion_steps"));
      }
}

/// Triangles of a technique's surface by patch and place, in an order of their own.
std::vector<std::array<double, 10>> sortedTriangles(Technique& technique, frame::Frame& frame) {
  technique.prepare(frame);
  frame.begin();
  technique.render(frame);
  frame.end();
  const auto surface = technique.tessellation(frame);
  std::vector<std::array<double, 10>> out;
  for (const glm::uvec3& t : surface->triangles) {
    std::array<double, 10> one{double(surface->patches[t.x])};
    for (int c = 0; c < 3; ++c) {
      const auto at = static_cast<size_t>(1 + 3 * c);
      const surfaces::DomainPoint& place = surface->parameters[t[c]];
      one[at] = place.u, one[at + 1] = place.v, one[at + 2] = place.restU;
    }
    out.push_back(one);
  }
  std::sort(out.begin(), out.end());
  return out;
}

// Bit by bit the same triangles, whatever the number of splits in a pass.
TEST_F(RecursionTechniques, GeometryShadersMakeWhatQueuesMake) {
  for (const char* name : {"curved/teapot", "curved/double_torus"})
    for (const char* split : {"quarters", "halves"}) {
      const scene::Scene scene = makeScene(name);
      const frame::GpuScene gpuScene(scene);
      frame::Frame frame(context(), scene, gpuScene, kSize);
      const auto triangles = [&](const char* technique, Given given) {
        given["split"] = std::string(split), given["tolerance_px"] = 0.1, given["grid"] = int64_t{2};
        const TechniqueInfo& info = TechniqueRegistry::instance().get(technique);
        return sortedTriangles(*info.make(ParameterValues(info.parameters, given)), frame);
      };
      const auto queues = triangles("recursion/queues", {});
      ASSERT_GT(queues.size(), 1000U);
      for (const int64_t levels : {1, 2, 3})
        EXPECT_EQ(triangles("recursion/geometry_shader", {{"levels", levels}}), queues)
            << name << " " << split << " " << levels;
    }
}

// 4 levels write 256 parts of 8 components; OpenGL grants 1024 components.
TEST_F(RecursionTechniques, GeometryShadersAreRefusedMoreThanTheyMayWrite) {
  GLint components = 0;
  glGetIntegerv(GL_MAX_GEOMETRY_TOTAL_OUTPUT_COMPONENTS, &components);
  const scene::Scene scene = makeScene("curved/teapot");
  if (components >= 2048) GTEST_SKIP() << "this driver grants " << components;
  EXPECT_THROW(render(scene, "recursion/geometry_shader", {{"levels", int64_t{4}}}, kSize), Error);
}

TEST_F(RecursionTechniques, GeometryShadersCountWhatDoesNotFit) {
  const scene::Scene scene = makeScene("curved/teapot");
  const Rendered made =
      render(scene, "recursion/geometry_shader",
             {{"tolerance_px", 0.1}, {"grid", int64_t{1}}, {"capacity", int64_t{1024}}, {"cull", false}},
             kSize, true);
  EXPECT_GT(made.counter("parts_left_out"), 0);
  EXPECT_LE(made.counter("faces"), 256);
}

// Full queues leave patches coarser, and say so; they leave no patch out while there is room for every patch.
TEST_F(RecursionTechniques, FullQueuesDrawCoarserParts) {
  const scene::Scene scene = makeScene("curved/teapot");
  const Rendered made =
      render(scene, "recursion/queues",
             {{"tolerance_px", 0.1}, {"grid", int64_t{1}}, {"capacity", int64_t{1024}}, {"cull", false}},
             kSize, true);
  EXPECT_GT(made.counter("parts_cut_short") + made.counter("parts_left_out"), 0);
  EXPECT_LE(made.counter("faces"), 256);
}

// The tolerance is that of cells: dicing takes the place of splits, not of accuracy.
TEST_F(RecursionTechniques, DicedPartsNeedFewerTestsForTheSameError) {
  const scene::Scene scene = makeScene("curved/teapot");
  const Rendered exact = render(scene, "tessellation/uniform_fine", {{"segments", int64_t{64}}}, {320, 240});
  std::vector<double> errors, tests;
  for (const int64_t grid : {1, 4}) {
    const Rendered made =
        render(scene, "recursion/queues", {{"tolerance_px", 0.25}, {"grid", grid}}, {320, 240}, true);
    errors.push_back(meanDifference(exact.product, made.product));
    tests.push_back(made.counter("parts_tested"));
  }
  EXPECT_LT(errors[1], 1.2 * errors[0]);
  EXPECT_LT(tests[1], 0.2 * tests[0]);
}

// Both rasterisers draw the same triangles: they differ by rounding at edges.
TEST_F(RecursionTechniques, ComputeRasterShowsWhatTheDriverShows) {
  for (const char* name : {"curved/teapot", "curved/double_torus"})
    for (const char* technique : {"recursion/queues", "recursion/geometry_shader"}) {
      const scene::Scene scene = makeScene(name);
      const Rendered driver = render(scene, technique, {{"raster", std::string("hardware")}}, kSize);
      const Rendered compute = render(scene, technique, {{"raster", std::string("compute")}}, kSize);
      EXPECT_LT(meanDifference(driver.product, compute.product), 2e-4) << name << " " << technique;
    }
}

TEST_F(RecursionTechniques, TheSurfaceReadBackIsExact) {
  const scene::Scene scene = makeScene("curved/teapot");
  const frame::GpuScene gpuScene(scene);
  frame::Frame frame(context(), scene, gpuScene, kSize);
  const TechniqueInfo& info = TechniqueRegistry::instance().get("recursion/queues");
  for (const int64_t grid : {1, 4}) {
    const auto technique = info.make(ParameterValues(info.parameters, {{"grid", grid}}));
    technique->prepare(frame);
    frame.begin();
    technique->render(frame);
    frame.end();
    const auto surface = technique->tessellation(frame);
    ASSERT_GT(surface->positions.size(), 500U);
    double most = 0.0;
    for (size_t i = 0; i < surface->positions.size(); ++i) {
      const surfaces::Patch& patch = scene.surfaces.patches[surface->patches[i]];
      const glm::dvec3 exact =
          surfaces::evaluate(scene.surfaces, patch, surface->parameters[i], surfaces::Order::Position).p;
      most = std::max(most, glm::length(surface->anchor + glm::dvec3(surface->positions[i]) - exact));
    }
    EXPECT_LT(most, 1e-6 * gpuScene.diagonal());
  }
}

}  // namespace
}  // namespace limen::techniques
