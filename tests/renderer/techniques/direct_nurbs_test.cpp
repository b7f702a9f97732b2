// SPDX-License-Identifier: BSD-3-Clause
// NURBS evaluated directly (SC-16, SC-17) against Bézier patches and in both forms.
#include "renderer/scene/curved/patch_mesh.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "renderer/surfaces/patch_builder.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

class DirectNurbs : public TechniqueTest {};

std::map<std::string, ParameterValue> formOf(const char* form, int64_t segments) {
  return {{"form", std::string(form)}, {"segments", segments}};
}

/// Random surfaces of degrees 1 to 5 with uneven and double knots, and weights from 0.2 to 5.
scene::Scene randomSurfaces() {
  scene::Random random(7);
  scene::Scene scene;
  for (int degree = 1; degree <= 5; ++degree) {
    surfaces::NurbsSurface of;
    of.degreeU = degree, of.degreeV = 6 - degree;
    const auto knots = [&](int p) {
      std::vector<double> out(size_t(p) + 1, -2.0);
      double at = -2.0;
      for (int k = 0; k < 5; ++k) {
        at += random.uniform(0.05, 1.0);
        out.insert(out.end(), k == 2 && p > 1 ? 2 : 1, at);
      }
      out.insert(out.end(), size_t(p) + 1, at + 0.5);
      return out;
    };
    of.knotsU = knots(of.degreeU), of.knotsV = knots(of.degreeV);
    for (int j = 0; j < of.pointsV(); ++j)
      for (int i = 0; i < of.pointsU(); ++i)
        of.points.push_back(surfaces::weighted(
            {degree + 0.9 * i / of.pointsU(), random.uniform(0.0, 0.3), -0.9 * j / of.pointsV()},
            std::pow(5.0, random.uniform(-1.0, 1.0))));
    scene.nurbs.push_back({of, uint32_t(scene.parts.size()), uint32_t(scene.surfaces.patches.size())});
    scene::addSurface(scene, "surface", surfaces::nurbsPatches(of), 4, glm::vec3(0.6F));
  }
  scene.lights = {scene::lightTowards({3, 5, 0}, {3, 0, 0}, glm::dvec2(1.0))};
  scene::setStillCamera(scene, scene::orbitCamera({3.5, 0.1, -0.4}, 7.0, 0.0, 60.0));
  return scene;
}

/// A point is a quotient of sums of up to 36 products of functions that take some ten operations each: an
/// error of some 30 roundings of 6e-8. Knots, which lie within 5, are rounded as well, by 5e-7 at most, and
/// over the shortest span, 0.05, that moves parameters by 1e-5 of it; points then move by no more than that
/// part of a cell, which is a hundredth of the diagonal.
TEST_F(DirectNurbs, MakesTheVerticesOfTheBezierPatches) {
  for (const scene::Scene& scene : {randomSurfaces(), makeScene("curved/nurbs_solids")})
    for (const char* form : {"each", "grid"}) {
      const Rendered made = render(scene, "tessellation/direct_nurbs", formOf(form, 5), {64, 48}, true);
      EXPECT_LT(made.counter("nurbs_error_of_diagonal"), 30 * 6e-8 + 1e-5 * 1e-2) << form;
      EXPECT_LT(made.counter("nurbs_normal_error_deg"), 0.1) << form;
      EXPECT_GT(made.counter("nurbs_vertices"), 1000) << form;
    }
}

TEST_F(DirectNurbs, ShowsWhatUniformPatchesShow) {
  const scene::Scene scene = makeScene("curved/nurbs_solids");
  const Image patches =
      render(scene, "tessellation/compute",
             {{"factors", std::string("uniform")}, {"factors.segments", int64_t{16}}}, {160, 120})
          .product;
  for (const char* form : {"each", "grid"}) {
    const Image direct = render(scene, "tessellation/direct_nurbs", formOf(form, 16), {160, 120}).product;
    // The same vertices: diagonals may differ, and silhouettes take another pixel here and there.
    EXPECT_LT(meanDifference(patches, direct), 1e-3) << form;
  }
}

}  // namespace
}  // namespace limen::techniques
