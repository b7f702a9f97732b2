// SPDX-License-Identifier: BSD-3-Clause
// The surfaces that techniques tessellate, read back: exact, without cracks, within bounds. Pictures:
// tessellation_test.cpp.
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

/// The surface that a technique makes in one frame.
class TessellatedSurfaces : public TechniqueTest {
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

/// 768 quartic triangles of 1,225 vertices: software renderers end a shader's loops after 65,535 rounds, so
/// no invocation may take too many vertices. Against double precision, 1e-5 of the extent.
TEST_F(TessellatedSurfaces, ManyVerticesOfQuarticTrianglesAreAllMade) {
  const scene::Scene scene = makeScene("curved/subdivision", text({{"approximation", "c_patches"}}));
  const auto made48 = made(scene, {{"factors", std::string("uniform")},
                                   {"factors.segments", int64_t{48}},
                                   {"capacity", int64_t{1000000}}});
  ASSERT_EQ(made48->positions.size(), 768U * 1225U);
  EXPECT_LE(largestError(scene, *made48), 1e-5 * 4.0);
}

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
        // What draws the surface is the same for all.
        if (raster == "compute" && lanes != 8 && lanes != 1024) continue;
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
  refused("tessellation/patterns", text({{"evaluation", "pixel"}, {"reuse", "soup"}}));
  refused("tessellation/patterns", text({{"evaluation", "pixel"}, {"draw", "multi_draw"}}));
  refused("tessellation/patterns", {{"evaluation", std::string("pixel")}, {"coarse_first", true}});
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
