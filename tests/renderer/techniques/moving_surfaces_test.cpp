// SPDX-License-Identifier: BSD-3-Clause
// Surfaces whose control points move: exact, without cracks and within bounds at any time.
#include <cmath>

#include "renderer/surfaces/bezier.h"
#include "renderer/surfaces/neighbours.h"
#include "renderer/surfaces/surface_errors.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

constexpr double kTimes[] = {0.0, 0.31, 0.77, 1.5, 23.9};  // of a period of 2 s

/// A flag of fewer patches, of weights that differ from point to point if `rational`.
scene::Scene flagScene(bool rational) {
  scene::Scene scene = scene::buildScene(
      "curved/flag", ParameterValues(scene::SceneRegistry::instance().get("curved/flag").allParameters(),
                                     {{"columns", int64_t{5}}, {"rows", int64_t{4}}, {"amplitude", 0.2}}));
  if (!rational) return scene;
  for (glm::dvec4& p : scene.surfaces.points) p *= 1.0 + 0.4 * std::sin(40.0 * p.x + 27.0 * p.y);
  surfaces::findNeighbours(scene.surfaces);
  return scene;
}

/// What PatchMotion states, written out.
surfaces::PatchSet setAt(const scene::Scene& scene, double timeS) {
  surfaces::PatchSet set = scene.surfaces;
  const double angle = 2.0 * M_PI * timeS / set.motion.periodS;
  for (size_t i = 0; i < set.points.size(); ++i) {
    const glm::dvec3 away = std::sin(angle) * set.motion.sine[i] + std::cos(angle) * set.motion.cosine[i];
    const double w = set.points[i].w;
    set.points[i] = glm::dvec4((glm::dvec3(set.points[i]) / w + away) * w, w);
  }
  return set;
}

class MovingSurfaces : public TechniqueTest {
 protected:
  /// visit(time, surface) of one technique at all times.
  template <class Visit>
  void atAllTimes(const scene::Scene& scene, const Given& given, Visit visit) {
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, {160, 120});
    const TechniqueInfo& info = TechniqueRegistry::instance().get("tessellation/compute");
    const auto technique = info.make(ParameterValues(info.parameters, given));
    technique->prepare(frame);
    for (const double time : kTimes) {
      frame.setTime(time);
      frame.begin();
      technique->render(frame);
      frame.end();
      visit(time, *technique->tessellation(frame));
    }
  }
};

TEST_F(MovingSurfaces, AreExactWithoutCracksAndWithinTheTolerance) {
  for (const bool rational : {false, true})
    for (const bool precompute : {false, true}) {
      const scene::Scene scene = flagScene(rational);
      const Given given = {{"factors.tolerance_px", 0.25}, {"precompute", precompute}};
      glm::dvec3 before(0.0);
      atAllTimes(scene, given, [&](double time, const surfaces::TessellatedSurface& surface) {
        SCOPED_TRACE(testing::Message()
                     << "rational " << rational << " precompute " << precompute << " time " << time);
        const surfaces::PatchSet set = setAt(scene, time);
        ASSERT_GT(surface.positions.size(), 500U);
        double most = 0.0;
        for (size_t i = 0; i < surface.positions.size(); ++i)
          most =
              std::max(most, glm::length(surface.anchor + glm::dvec3(surface.positions[i]) -
                                         surfaces::evaluate(set, set.patches[surface.patches[i]],
                                                            surface.parameters[i], surfaces::Order::Position)
                                             .p));
        // Some ten roundings of float at distances below 2.
        EXPECT_LT(most, 10 * 2 * 6e-8);
        // The bound of rational patches is one to the closest point.
        EXPECT_LT(surfaces::deviationOf(set, surface, {8, 40000}).closestPx.most, 0.25);
        const surfaces::Cracks cracks = surfaces::cracksOf(set, surface);
        EXPECT_EQ(cracks.sides, 31);  // 4 x 4 and 5 x 3 common ones
        EXPECT_EQ(cracks.unequalVertices, 0);
        EXPECT_EQ(cracks.loneVertices, 0);
        EXPECT_EQ(cracks.openEdges, 0);
        EXPECT_EQ(cracks.foldOvers, 0);
        // It does move: the last vertex is one of the free end's patches.
        const glm::dvec3 now = surface.anchor + glm::dvec3(surface.positions.back());
        EXPECT_GT(glm::length(now - before), 0.01);
        before = now;
      });
    }
}

/// Bounds over the whole motion do not depend on the time; those of the moment are no larger.
TEST_F(MovingSurfaces, BoundsMadeOnceHoldThroughoutAPeriod) {
  const scene::Scene scene = flagScene(false);
  std::vector<surfaces::Factors> first;
  size_t most = 0, made = 0;
  atAllTimes(scene, {{"precompute", true}, {"cull", false}},
             [&](double, const surfaces::TessellatedSurface& surface) {
               if (first.empty()) first = surface.factors;
               EXPECT_EQ(surface.factors, first);
               made = surface.triangles.size();
             });
  atAllTimes(scene, {{"cull", false}}, [&](double time, const surfaces::TessellatedSurface& surface) {
    for (size_t i = 0; i < first.size(); ++i)
      for (size_t side = 0; side < 4; ++side) EXPECT_LE(surface.factors[i][side], first[i][side]) << time;
    most = std::max(most, surface.triangles.size());
  });
  EXPECT_LE(most, made);
}

TEST_F(MovingSurfaces, ArePicturesOfWhatRaysMeet) {
  const scene::Scene scene = flagScene(true);
  const frame::GpuScene gpuScene(scene);
  const auto picture = [&](const std::string& name, double time) {
    frame::Frame frame(context(), scene, gpuScene, {128, 96});
    const TechniqueInfo& info = TechniqueRegistry::instance().get(name);
    const auto technique = info.make(ParameterValues(info.parameters, {}));
    technique->prepare(frame);
    frame.setTime(time);
    frame.begin();
    technique->render(frame);
    frame.end();
    return technique->product().read();
  };
  const Image exact = picture("ray_casting/exact", 0.6);
  // Half a pixel at silhouettes, some 200 pixels long, may change as many pixels of 12,288 by a grey level's
  // 0.3 or so.
  for (const char* name : {"tessellation/compute", "tessellation/hardware"})
    EXPECT_LT(meanDifference(exact, picture(name, 0.6)), 0.5 * 200 * 0.3 / 12288) << name;
  EXPECT_GT(meanDifference(exact, picture("tessellation/compute", 0.0)), 0.5 * 200 * 0.3 / 12288);
}

TEST_F(MovingSurfaces, AreRefusedByWhatWouldDrawThemAtRest) {
  const scene::Scene scene = flagScene(false);
  for (const char* technique : {"tessellation/patterns", "recursion/cpu", "recursion/queues"})
    EXPECT_THROW(render(scene, technique, {}, {32, 24}), Error) << technique;
}

}  // namespace
}  // namespace limen::techniques
