// SPDX-License-Identifier: BSD-3-Clause
#include "tests/renderer/techniques/reflections/reflection_fixture.h"

namespace limen::techniques {
namespace {

class EnvironmentMaps : public ReflectionTest {
 protected:
  /// A small ball in the middle of a large one of flat white light above y = 0 and black below; both around
  /// the origin.
  static scene::Scene ballInSphere(double ballRadius) {
    scene::Scene scene;
    scene::Mesh ball = scene::sphere(glm::dvec3(0.0), ballRadius, 32);
    for (const glm::dvec3& p : ball.positions) ball.normals.emplace_back(glm::normalize(p));
    scene::Material mirror = mirrorMaterial(1.0F);
    mirror.albedo = glm::vec3(0.0F);
    scene::addPart(scene, ball, mirror);
    const scene::Mesh shell = scene::sphere(glm::dvec3(0.0), 20.0, 32);
    scene::Mesh above = shell, below = shell;
    above.triangles.clear(), below.triangles.clear();
    for (const glm::uvec3& t : shell.triangles) {
      const double y = shell.positions[t.x].y + shell.positions[t.y].y + shell.positions[t.z].y;
      (y > 0.0 ? above : below).triangles.push_back(t);
    }
    scene::addPart(scene, "above", above, glm::vec3(1.0F));
    scene::addPart(scene, "below", below, glm::vec3(0.0F));
    scene::setStillCamera(scene, scene::orbitCamera(glm::dvec3(0.0), 5.0, 0.0, 0.0, 24.0 * ballRadius));
    return scene;
  }
  static Given plain(Given more = {}) {
    more["shading.ambient"] = 1.0;
    more["shading.diffuse"] = 0.0;
    return more;
  }
};

/// Where the surroundings are far away compared with the mirror, all forms of lookup show what the reference
/// shows, but for pixels at the horizon: a ball of 0.1 in a sphere of 20 sees it shifted by 0.005 rad at
/// most, a texel of 256 is 0.006 rad. On a mirroring ball 45 degrees of the normal's angle hold 90 of the
/// reflection: 100 px of ball have a pixel for each 2 / (50 cos 45) = 0.06 rad there: less than one pixel on
/// either side of the horizon, a row of 110; and columns of the silhouette, where a pixel's change of
/// direction has no limit: 4 %.
TEST_F(EnvironmentMaps, OfFarSurroundingsShowWhatTheReferenceShows) {
  const scene::Scene scene = ballInSphere(0.1);
  const Image truth = render(scene, "reflections/reference", plain(), {120, 120}).product;
  for (const char* lookup : {"infinite", "finite", "depth"})
    for (const char* filter : {"nearest", "linear"}) {
      const Given given = plain({{"lookup", std::string(lookup)}, {"filter", std::string(filter)}});
      const Image found = render(scene, "reflections/environment_map", given, {120, 120}).product;
      EXPECT_LE(differing(found, truth, 0.02).count, 360U) << lookup << ' ' << filter;
    }
}

/// The lookup by depth is right where the surroundings are near as well, as they are all seen from the
/// middle; the one by direction alone is not.
TEST_F(EnvironmentMaps, DepthGivesParallax) {
  const scene::Scene scene = makeScene("mirrors/ball", {{"tessellation", int64_t{24}}});
  const Image truth = render(scene, "reflections/reference", {}, {96, 72}).product;
  const auto error = [&](const char* lookup) {
    const Given given = {{"lookup", std::string(lookup)}, {"resolution", int64_t{512}}};
    return meanDifference(render(scene, "reflections/environment_map", given, {96, 72}).product, truth);
  };
  const double depth = error("depth"), infinite = error("infinite");
  EXPECT_LT(depth, 0.5 * infinite);
}

/// Share of the light of a half-space that a lobe cos^n gathers whose axis has this elevation: over the
/// circles around the axis, each of which is above the horizon for a part of its length.
double shareAbove(double n, double elevation) {
  constexpr int kCircles = 20000;
  double sum = 0.0, total = 0.0;
  for (int i = 0; i < kCircles; ++i) {
    const double cosine = (i + 0.5) / kCircles, sine = std::sqrt(1.0 - cosine * cosine);
    const double edge = std::clamp(-cosine * std::sin(elevation) / (sine * std::cos(elevation)), -1.0, 1.0);
    const double weight = std::pow(cosine, n);
    sum += weight * std::acos(edge) / 3.14159265358979;
    total += weight;
  }
  return sum / total;
}

/// Light of 1 from the half-space above: of a power n = 1 of the cosine with an axis at angle a to the
/// vertical the mean is (1 + cos a) / 2, which is the classic form factor of a tilted plane; for n = 20 with
/// the axis vertical it is 1, horizontal 1/2, by symmetry. Texels: half of one of 32 a face at the border of
/// light is 1.4 degrees of 180: 0.016, weighted by at most (n + 1) / 2 of the mean over the axis: for n = 20
/// the lobe's profile across its middle is sqrt(20 / 2 pi) = 1.8 a radian, of 0.05 rad 0.09 / 2.
TEST_F(EnvironmentMaps, PrefilteredLightIsTheIntegral) {
  const scene::Scene scene = ballInSphere(0.1);
  EXPECT_NEAR(shareAbove(1.0, 0.5), 0.5 * (1.0 + std::sin(0.5)), 1e-4);
  for (const double exponent : {1.0, 20.0}) {
    const Given given = plain({{"prefilter", std::string("lobe")},
                               {"prefilter.exponent", exponent},
                               {"prefilter.source_resolution", int64_t{32}},
                               {"prefilter.resolution", int64_t{32}}});
    const Image found = render(scene, "reflections/environment_map", given, {121, 121}).product;
    const frame::GpuScene gpuScene(scene);
    // The ball's normals turn from the camera upwards along the middle column; the mirrored axis by twice the
    // angle.
    size_t compared = 0;
    for (int y = 61; y > 0; --y) {
      const double value = found.at(60, y, 0);
      const double height = (60.5 - (y + 0.5)) / 121.0 * 2.0 * std::tan(glm::radians(1.2)) * 5.0 / 0.1;
      if (height < 0.0 || height > 0.7) continue;
      const double elevation = 2.0 * std::asin(height);  // of the axis, above the horizon
      const double expected = shareAbove(exponent, elevation);
      ++compared;
      EXPECT_NEAR(value, expected, exponent == 1.0 ? 0.016 : 0.05) << "exponent " << exponent << " row " << y;
    }
    EXPECT_GE(compared, 35U);
  }
}

/// A ball before a wall with a box in between: rays that lead behind the box slip past its border.
TEST_F(EnvironmentMaps, CracksAreCounted) {
  const scene::Scene scene = makeScene("mirrors/ball", {{"tessellation", int64_t{24}}});
  const Rendered depth =
      render(scene, "reflections/environment_map", {{"lookup", std::string("depth")}}, {96, 72}, true);
  EXPECT_GT(depth.counter("crack_px"), 0.0);
  EXPECT_LT(depth.counter("crack_px"), 0.25 * depth.counter("mirror_px"));
  const Rendered empty = render(ballInSphere(0.1), "reflections/environment_map",
                                plain({{"lookup", std::string("depth")}}), {96, 72}, true);
  EXPECT_EQ(empty.counter("crack_px"), 0.0);
}

/// What lies behind an object's border is known to the second layer: fewer rays slip behind both, and the
/// picture is nearer to the truth. Where nothing lies behind anything the second layer changes nothing.
TEST_F(EnvironmentMaps, ASecondLayerClosesCracks) {
  const scene::Scene scene = makeScene("mirrors/ball", {{"tessellation", int64_t{24}}});
  const Image truth = render(scene, "reflections/reference", {}, {96, 72}).product;
  const auto of = [&](const scene::Scene& in, int layers, Given more) {
    more["lookup"] = std::string("depth");
    more["lookup.layers"] = int64_t{layers};
    return render(in, "reflections/environment_map", more, {96, 72}, true);
  };
  const Rendered one = of(scene, 1, {{"resolution", int64_t{512}}}),
                 two = of(scene, 2, {{"resolution", int64_t{512}}});
  EXPECT_LT(two.counter("crack_px"), 0.5 * one.counter("crack_px"));
  EXPECT_LT(meanDifference(two.product, truth), meanDifference(one.product, truth));
  const scene::Scene convex = ballInSphere(0.1);
  EXPECT_EQ(differing(of(convex, 2, plain()).product, of(convex, 1, plain()).product, 0.0).count, 0U);
}

/// A map of one colour stays so, filtered beforehand and looked up in any way: it is the filtered map that is
/// looked up, and the unfiltered one that has the distances.
TEST_F(EnvironmentMaps, FilteredMapsAreLookedUpInAnyWay) {
  scene::Scene scene = ballInSphere(0.1);
  for (scene::Material& material : scene.materials)
    if (!material.reflects()) material.albedo = glm::vec3(0.5F);
  for (const char* lookup : {"infinite", "depth"})
    for (const char* filter : {"nearest", "linear"}) {
      const Image found = render(scene, "reflections/environment_map",
                                 plain({{"prefilter", std::string("lobe")},
                                        {"prefilter.resolution", int64_t{8}},
                                        {"lookup", std::string(lookup)},
                                        {"filter", std::string(filter)}}),
                                 {61, 61})
                              .product;
      // Sums of 6 * 32^2 weights in float.
      EXPECT_NEAR(found.at(30, 30, 0), 0.5, 1e-4) << lookup << ' ' << filter;
    }
}

}  // namespace
}  // namespace limen::techniques
