// SPDX-License-Identifier: BSD-3-Clause
// Trimmed surfaces (SC-18): areas in pictures and meshes against those of the circles, and tessellations
// against rays.
#include <cmath>

#include "renderer/scene/curved/patch_mesh.h"
#include "renderer/scene/stage.h"
#include "renderer/surfaces/nurbs.h"
#include "renderer/surfaces/patch_builder.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

constexpr int kSide = 200;
constexpr double kPixel = 2.4 / kSide;  // of the plate's plane, world units

/// A ring with a disc in its hole, in the unit square: radii and what they leave.
constexpr double kRadii[] = {0.4, 0.25, 0.1};
const double kArea = M_PI * (0.4 * 0.4 - 0.25 * 0.25 + 0.1 * 0.1), kLength = 2.0 * M_PI * (0.4 + 0.25 + 0.1);

surfaces::TrimRegion ring() {
  surfaces::TrimRegion out;
  for (const double radius : kRadii) out.loops.push_back(surfaces::trimCircle(glm::dvec2(0.5), radius, 64));
  return out;
}

/// The square from -1 to 1 at z = 0, facing the camera, of six patches of degrees 3 and 2: with Greville
/// abscissae for control points, parameters are coordinates.
surfaces::NurbsSurface plate() {
  surfaces::NurbsSurface out;
  out.degreeU = 3, out.degreeV = 2;
  out.knotsU = {0, 0, 0, 0, 0.3, 0.45, 1, 1, 1, 1};
  out.knotsV = {5, 5, 5, 5.8, 7, 7, 7};
  const auto greville = [](const std::vector<double>& knots, int degree, int i) {
    double sum = 0.0;
    for (int k = 1; k <= degree; ++k) sum += knots[size_t(i + k)];
    const double low = knots.front(), high = knots.back();
    return 2.0 * (sum / degree - low) / (high - low) - 1.0;
  };
  for (int j = 0; j < out.pointsV(); ++j)
    for (int i = 0; i < out.pointsU(); ++i)
      out.points.push_back(surfaces::weighted({greville(out.knotsU, 3, i), greville(out.knotsV, 2, j), 0.0}));
  return out;
}

scene::Scene plateScene() {
  scene::Scene scene;
  scene::addSurface(scene, "plate", surfaces::trimmedNurbsPatches(plate(), ring()), 16, glm::vec3(0.7F));
  scene.lights = {scene::lightTowards({0, 0, 5}, {0, 0, 0}, glm::dvec2(1.0))};
  scene::setStillCamera(scene, {{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, glm::degrees(2.0 * std::atan(0.3))});
  return scene;
}

/// Pixels that are not the background's colour, which a corner has.
std::vector<bool> covered(const Image& picture) {
  std::vector<bool> out;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      float change = 0.0F;
      for (int c = 0; c < 3; ++c) change += std::abs(picture.at(x, y, c) - picture.at(0, 0, c));
      out.push_back(change > 1e-3F);
    }
  return out;
}
int64_t countOf(const std::vector<bool>& mask) { return std::count(mask.begin(), mask.end(), true); }

class TrimmedSurfaces : public TechniqueTest {};

/// Pixel centres near a curve of length L count for or against the area: about 2 L / pixel of them with an
/// error of at most half a pixel's area each, independent of one another. Four of their sum's standard
/// deviations.
double countingError() { return 4.0 * std::sqrt(2.0 * 2.0 * kLength / kPixel) * 0.5 * kPixel * kPixel; }

TEST_F(TrimmedSurfaces, TheAreaInAPictureIsThatOfTheCircles) {
  const scene::Scene scene = plateScene();
  const Rendered made = render(scene, "tessellation/compute", {}, {kSide, kSide}, true);
  const double area = double(countOf(covered(made.product))) * kPixel * kPixel;
  // Interpolated distances to a circle of radius R are wrong by t^2 / 8 R at most between texels t apart in
  // either direction, t^2 / 4 R in both; times its length, 2 pi R: each of the circles t^2 pi / 2. The plate
  // is twice as wide as the domain.
  const double t = 1.0 / 256;
  EXPECT_NEAR(area, 4.0 * kArea, countingError() + 4.0 * 3 * M_PI / 2 * t * t);
  EXPECT_LT(made.counter("trim_error"), 3 * M_PI / 2 * t * t + 1e-3);
  const Rendered exact = render(scene, "ray_casting/exact", {}, {kSide, kSide});
  EXPECT_NEAR(double(countOf(covered(exact.product))) * kPixel * kPixel, 4.0 * kArea, countingError());
}

/// Pixel by pixel against rays that know the curves. A pixel is wrong only if its centre lies within the
/// texture's error of a curve: half a texel's diagonal if texels say inside or outside.
TEST_F(TrimmedSurfaces, TexturesAreWrongInABandAlongTheCurves) {
  const scene::Scene scene = plateScene();
  const std::vector<bool> exact = covered(render(scene, "ray_casting/exact", {}, {kSide, kSide}).product);
  const auto wrongOf = [&](const std::string& technique, const char* content, int resolution) {
    Given given = {{"trims.content", std::string(content)}, {"trims.resolution", int64_t{resolution}}};
    if (technique == "ray_casting/exact") given["trims"] = std::string("texture");
    const std::vector<bool> found = covered(render(scene, technique, given, {kSide, kSide}).product);
    int64_t wrong = 0;
    for (size_t i = 0; i < exact.size(); ++i) wrong += exact[i] != found[i];
    return double(wrong) * kPixel * kPixel / 4.0;  // of the domain
  };
  for (const char* technique : {"tessellation/compute", "ray_casting/exact"}) {
    double last = 1.0;
    for (const int resolution : {16, 32, 64}) {
      const double inside = wrongOf(technique, "inside", resolution),
                   distance = wrongOf(technique, "distance", resolution);
      EXPECT_LT(inside, kLength * std::sqrt(0.5) / resolution + 0.25 * countingError()) << technique;
      EXPECT_LT(inside, last / 1.5) << technique;
      EXPECT_LT(distance, inside / 2) << technique;
      last = inside;
    }
    // A fault in the places that fragments look up would move the ring.
    EXPECT_LT(wrongOf(technique, "distance", 256), 1e-3) << technique;
  }
}

/// The mesh ends where its edges meet the curves: between these it follows chords. A cell of c has chords of
/// at most c sqrt(2), whose sagitta is c^2 / 4 R; times two thirds of the length, 2 pi R, each circle is
/// wrong by at most c^2 pi / 3.
TEST_F(TrimmedSurfaces, MeshesEndAtTheCurves) {
  const surfaces::PatchSet set = surfaces::trimmedNurbsPatches(plate(), ring());
  for (const int factor : {16, 32}) {
    const scene::Mesh mesh = scene::patchMesh(set, factor);
    double area = 0.0;
    for (const glm::uvec3& t : mesh.triangles)
      area +=
          0.5 *
          glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]).z;
    const double cell = 0.6 / factor;  // the largest patch is 0.55 x 0.6
    EXPECT_NEAR(area, 4.0 * kArea, 4.0 * 3 * cell * cell * M_PI / 3) << factor;
  }
}

/// Edges of holes on curved surfaces: a pixel may differ where a silhouette or a hole's edge passes within
/// the tolerance.
TEST_F(TrimmedSurfaces, SolidsShowWhatRaysShow) {
  const scene::Scene scene = makeScene("curved/trimmed");
  const Given fine = {{"factors.tolerance_px", 0.1}, {"trims.resolution", int64_t{512}}};
  const Image made = render(scene, "tessellation/compute", fine, {160, 120}).product,
              exact = render(scene, "ray_casting/exact", {}, {160, 120}).product;
  int64_t differ = 0;
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x) differ += std::abs(made.at(x, y, 1) - exact.at(x, y, 1)) > 0.05F;
  // Tolerance 0.1 px along some 3,000 pixels of edges: each differs with a chance of 0.1 at most.
  EXPECT_LT(differ, 300);
  // What the trims are worth: without them a hundred times as many pixels differ.
  scene::Scene whole = scene;
  whole.surfaces.trims.clear(), whole.surfaces.trimOf.clear();
  const Image untrimmed = render(whole, "ray_casting/exact", {}, {160, 120}).product;
  int64_t holes = 0;
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x) holes += std::abs(untrimmed.at(x, y, 1) - exact.at(x, y, 1)) > 0.05F;
  EXPECT_GT(holes, 1000);
}

TEST_F(TrimmedSurfaces, WhatCannotTrimRefuses) {
  const scene::Scene scene = plateScene();
  for (const char* technique :
       {"tessellation/hardware", "tessellation/patterns", "recursion/cpu", "recursion/queues"})
    EXPECT_THROW(render(scene, technique, {}, {32, 24}), Error) << technique;
  EXPECT_THROW(render(scene, "tessellation/compute", {{"raster", std::string("compute")}}, {32, 24}), Error);
  EXPECT_THROW(
      render(scene, "tessellation/compute", {{"evaluation", std::string("vertex_shader")}}, {32, 24}), Error);
}

}  // namespace
}  // namespace limen::techniques
