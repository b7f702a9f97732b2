// SPDX-License-Identifier: BSD-3-Clause
// Pictures of reflections/vertex_reflection beside those of rays.
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

const std::string kVertices = "reflections/vertex_reflection", kRays = "reflections/ray_traced";

class VertexReflectionPicture : public TechniqueTest {
 protected:
  static constexpr glm::ivec2 kSize{160, 120};

  static Given evenly(int64_t segments, Given more = {}) {
    more["tessellation"] = std::string("even");
    more["tessellation.segments"] = segments;
    if (!more.count("invalid")) more["invalid"] = std::string("drop");
    return more;
  }

  /// Share of all pixels whose largest channel differs by more than `threshold`.
  static double shareOff(const Image& a, const Image& b, double threshold = 0.05) {
    int off = 0;
    for (int y = 0; y < a.height; ++y)
      for (int x = 0; x < a.width; ++x) {
        double most = 0.0;
        for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(double(a.at(x, y, c)) - b.at(x, y, c)));
        if (!(most <= threshold)) ++off;
      }
    return double(off) / (a.width * a.height);
  }

  static Image picture(const scene::Scene& scene, const std::string& technique, const Given& given = {}) {
    return render(scene, technique, given, kSize).product;
  }
};

/// The mirror covers a sixth of the picture (its outline: a circle of 48 px across). Within it, edges between
/// cells of the floor and outlines of objects are a few hundred pixels long; those may take the other side.
/// That is under 2 % of the picture. A picture without reflections is off in most of the mirror's lower half.
TEST_F(VertexReflectionPicture, AgreesWithRaysOnABall) {
  const scene::Scene scene = makeScene("mirrors/ball", {{"tessellation", int64_t{64}}});
  const Image rays = picture(scene, kRays);
  EXPECT_LT(shareOff(picture(scene, kVertices, evenly(8)), rays), 0.02);
  EXPECT_LT(shareOff(picture(scene, kVertices), rays), 0.02);
  // The thesis' end of the search is seen to be too early.
  const Given thesis = evenly(8, {{"solver.guess", std::string("projections")},
                                  {"solver.stop", std::string("area")},
                                  {"solver.stop_area_px2", 1.0},
                                  {"solver.safeguard", std::string("none")}});
  EXPECT_GT(shareOff(picture(scene, kVertices, thesis), rays), 0.02);
}

TEST_F(VertexReflectionPicture, AgreesWithRaysOnAnEllipsoidAndInTwoParts) {
  for (const char* mirror : {"ellipsoid", "two_spheres"}) {
    const scene::Scene scene =
        makeScene("mirrors/shapes", {{"mirror", std::string(mirror)}, {"objects", int64_t{6}}});
    EXPECT_LT(shareOff(picture(scene, kVertices), picture(scene, kRays)), 0.02) << mirror;
  }
}

/// Compute and vertex shader run the same search; compilers may round differently.
TEST_F(VertexReflectionPicture, IsTheSameWhereverVerticesAreSolved) {
  const scene::Scene scene = makeScene("mirrors/ball", {{"tessellation", int64_t{24}}});
  const Image before = picture(scene, kVertices, evenly(4));
  const Image within = picture(scene, kVertices, evenly(4, {{"placement", std::string("vertex_shader")}}));
  EXPECT_LT(shareOff(before, within, 1e-4), 0.002);
}

/// The map as an image, read by the GPU's own filtering: both layouts know the same surface. Texels of 1/128
/// of a face are 1 / 80 rad apart; of an ellipsoid's radius the second difference over that is 1e-4.
TEST_F(VertexReflectionPicture, LayoutsOfTheMapAgree) {
  const scene::Scene scene =
      makeScene("mirrors/shapes", {{"mirror", std::string("ellipsoid")}, {"objects", int64_t{6}}});
  const Image cube = picture(scene, kVertices);
  const Image angles =
      picture(scene, kVertices, {{"map.layout", std::string("lat_long")}, {"map.resolution", int64_t{256}}});
  EXPECT_LT(shareOff(cube, angles), 0.02);
}

/// A highlight is where the mirror sees it, not where the eye would.
TEST_F(VertexReflectionPicture, HighlightsAreThoseThatTheMirrorSees) {
  scene::Scene scene = makeScene("mirrors/shapes", {{"objects", int64_t{0}}});
  const Given shiny = {{"shading.specular", 2.0}, {"shading.shininess", 8.0}, {"shading.diffuse", 0.2}};
  Given fromEye = shiny;
  fromEye["lit_from"] = std::string("eye");
  const Image rays = picture(scene, kRays, shiny);
  const double right = shareOff(picture(scene, kVertices, shiny), rays);
  const double wrong = shareOff(picture(scene, kVertices, fromEye), rays);
  EXPECT_LT(right, 0.02);
  EXPECT_GT(wrong, 2.0 * right);
}

/// Errors of vertices against reflection points found in double precision on the mesh itself. Sides of the
/// last triangle are below 0.014 px; the map's texels add their interpolation of facets 1/64 of a quarter
/// circle wide, of a sagitta of 1.5e-4 radii or 0.005 px, seen at a slant.
TEST_F(VertexReflectionPicture, VerticesAreWithinAFractionOfAPixel) {
  const scene::Scene scene = makeScene("mirrors/ball", {{"tessellation", int64_t{64}}});
  const Rendered rendered = render(scene, kVertices, evenly(2), kSize, true);
  EXPECT_GT(rendered.counter("true_points"), 500.0);
  EXPECT_LT(rendered.counter("screen_error_median_px"), 0.01);
  EXPECT_LT(rendered.counter("screen_error_p95_px"), 0.1);
  EXPECT_EQ(rendered.counter("vertices_no_surface"), 0.0);
  EXPECT_EQ(rendered.counter("true_points_maximum"), 0.0);  // convex mirrors have none
  // What the ball hides has no reflection.
  EXPECT_GT(rendered.counter("vertices_false_root"), 0.0);
}

/// The environment map is seen from the mirror's middle: the farther its objects, the less that matters. The
/// floor from 3 radii on is seen from half a radius beside: at most 1/6 rad aside, but along the floor's
/// distant part, where this moves edges by little. Without the map (a distance beyond the scene) nothing may
/// change at all; with it a gap would show the background in a sixth of the picture's pixels.
TEST_F(VertexReflectionPicture, AnEnvironmentMapContinuesWhatVerticesShow) {
  scene::Scene scene = makeScene("mirrors/shapes", {{"objects", int64_t{6}}});
  const auto with = [](double distance) {
    return Given{{"surroundings", std::string("environment")}, {"surroundings.distance", distance}};
  };
  const Image plain = picture(scene, kVertices);
  EXPECT_LT(shareOff(picture(scene, kVertices, with(100.0)), plain, 1e-4), 1e-3);
  // Without the floor's checks, a gap is all that may be seen.
  scene.materials[0].pattern.kind = scene::Pattern::Kind::None;
  EXPECT_LT(shareOff(picture(scene, kVertices, with(3.0)), picture(scene, kRays)), 0.02);
}

/// Of a plate in contact with the mirror one vertex coincides with its reflection; nothing becomes infinite.
TEST_F(VertexReflectionPicture, ContactIsFinite) {
  const scene::Scene scene = makeScene("mirrors/contact");
  const Image contact = picture(scene, kVertices);
  for (const float value : contact.data) ASSERT_TRUE(std::isfinite(value));
  EXPECT_LT(shareOff(contact, picture(scene, kRays)), 0.02);
}

/// What the eye sees behind the mirror's far side must not show through: without the test of back faces a
/// reflection could only gain pixels. Against rays it must not lose any that are right.
TEST_F(VertexReflectionPicture, BackFacesHideNothingThatIsSeen) {
  const scene::Scene scene = makeScene("mirrors/ball", {{"tessellation", int64_t{32}}});
  const Image rays = picture(scene, kRays);
  const double hiding = shareOff(picture(scene, kVertices, evenly(8)), rays);
  const double all = shareOff(picture(scene, kVertices, evenly(8, {{"hide_behind_backs", false}})), rays);
  EXPECT_LT(hiding, 0.02);
  EXPECT_LT(hiding, all + 0.005);
}

/// Path lengths are convex along a triangle: interpolated between far corners they are too long. A wall of
/// small triangles 0.005 behind plates of two triangles, 0.45 x 0.63, at distances of about 1, whose middles
/// come out some 0.3^2 / 2 too far, shows through; divided by 8, 64 times less, it does not.
TEST_F(VertexReflectionPicture, FineSurfacesShowThroughCoarseOnesBeforeThem) {
  const scene::Scene scene = makeScene("mirrors/layers");
  const auto platePixels = [&](const Image& image) {
    int count = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) count += image.at(x, y, 0) > 1.5F * image.at(x, y, 2) ? 1 : 0;
    return count;
  };
  const int right = platePixels(picture(scene, kRays));
  EXPECT_GT(right, 50);
  EXPECT_LT(platePixels(picture(scene, kVertices, evenly(1))), 0.7 * right);
  EXPECT_GT(platePixels(picture(scene, kVertices, evenly(8))), 0.9 * right);
}

/// Small motions of the eye move reflection points in proportion: between frames apart by 0.001 distances,
/// the change of a point's error is within the search's own end (0.014 px) and the map's.
TEST_F(VertexReflectionPicture, PointsFollowTheEyeWithoutJumps) {
  scene::Scene scene = makeScene("mirrors/ball", {{"tessellation", int64_t{64}}});
  double p95 = 0.0;
  for (int i = 0; i < 2; ++i) {
    scene.camera.keys[0].camera.eye += glm::dvec3(0.003, 0.0, 0.0);
    p95 = std::max(p95, render(scene, kVertices, evenly(2), kSize, true).counter("screen_error_p95_px"));
  }
  EXPECT_LT(p95, 0.1);
}

/// An eye that moves by a hundredth of its distance moves points by about as much: a start from there is
/// nearer than one from a triangle of half a radius, by a factor of ten or more, which is worth a step or two
/// of a method whose error falls with a power of 1.5 or so. It must find the same points.
TEST_F(VertexReflectionPicture, APreviousFrameSavesSteps) {
  const scene::Scene scene = makeScene("mirrors/ball", {{"tessellation", int64_t{64}}});
  const Rendered fresh = render(scene, kVertices, evenly(4), kSize, true);
  const Rendered again = render(
      scene, kVertices,
      evenly(4, {{"solver.guess", std::string("previous_frame")}, {"solver.least_side", 0.02}}), kSize, true);
  EXPECT_LT(again.counter("iterations_mean"), fresh.counter("iterations_mean") - 1.0);
  EXPECT_LT(again.counter("screen_error_p95_px"), 0.1);
}

TEST_F(VertexReflectionPicture, MirrorsThatNoPointSeesAreRefused) {
  scene::Scene scene = makeScene("mirrors/shapes", {{"mirror", std::string("sphere")}});
  scene::Mesh two = scene::sphere({-1.0, 0.5, 0.0}, 0.3, 8);
  scene::append(two, scene::sphere({1.0, 0.5, 0.0}, 0.3, 8));
  scene::Material material;
  material.name = "pair";
  material.mirror = glm::vec3(0.8F);
  scene::addPart(scene, two, material);
  try {
    picture(scene, kVertices);
    FAIL() << "taken";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("pair"), std::string::npos);
  }
}

TEST_F(VertexReflectionPicture, ContradictionsAreRefused) {
  EXPECT_TRUE(
      refusal(kVertices, {{"tessellation", std::string("even")}, {"invalid", std::string("subdivide")}}));
  EXPECT_TRUE(refusal(kVertices, {{"placement", std::string("vertex_shader")},
                                  {"solver.guess", std::string("previous_frame")}}));
}

}  // namespace
}  // namespace limen::techniques
