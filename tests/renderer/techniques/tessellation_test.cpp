// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "renderer/frame/shaded.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

class Tessellation : public TechniqueTest {
 protected:
  static double meanDifference(const Image& a, const Image& b) {
    double sum = 0.0;
    for (int y = 0; y < a.height; ++y)
      for (int x = 0; x < a.width; ++x)
        for (int c = 0; c < 3; ++c) sum += std::abs(double(a.at(x, y, c)) - b.at(x, y, c));
    return sum / (3.0 * a.width * a.height);
  }
};

TEST_F(Tessellation, UniformFactorsMakeTheVerticesAndIndicesOfTheClosedForm) {
  const scene::Scene teapot = makeScene("curved/teapot");
  for (const char* form : {"vertex_parallel", "patch_parallel"}) {
    const Rendered made = render(teapot, "tessellation/compute",
                                 {{"factors", std::string("uniform")},
                                  {"factors.segments", int64_t{5}},
                                  {"cull", false},
                                  {"form", std::string(form)}},
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

}  // namespace
}  // namespace limen::techniques
