// SPDX-License-Identifier: BSD-3-Clause
// Biases of techniques that compare receivers with texels of the map itself: hard shadows, percentage-closer
// filtering and soft shadows. Expected values are those of planes.
#include <cmath>
#include <glm/glm.hpp>

#include "renderer/scene/stage.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

class PercentageCloser : public TechniqueTest {
 protected:
  static constexpr const char *kHard = "soft_shadows/hard", *kPcf = "soft_shadows/pcf",
                              *kPcss = "soft_shadows/pcss";

  /// A plane that leans away from the light and nothing else.
  static scene::Scene leaningPlane(double tilt, double lightSize) {
    scene::Scene scene = makeScene("resting_sphere", {{"tilt", tilt}, {"light_size", lightSize}});
    scene.parts.resize(1);
    scene.mesh.triangles.resize(scene.parts[0].triangleCount);
    return scene;
  }

  /// Adds a rectangle at a height, parallel to the light of leaningPlane(), as a part of its own.
  static void addRectangle(scene::Scene& scene, double height, glm::dvec2 low, glm::dvec2 high) {
    scene::Part part = scene.parts[0];
    part.firstTriangle = static_cast<uint32_t>(scene.mesh.triangles.size());
    part.triangleCount = 2;
    const auto first = static_cast<uint32_t>(scene.mesh.positions.size());
    for (const glm::dvec2 at : {low, glm::dvec2(high.x, low.y), high, glm::dvec2(low.x, high.y)})
      scene.mesh.positions.emplace_back(at.x, height, at.y);
    scene.mesh.triangles.emplace_back(first, first + 2, first + 1);
    scene.mesh.triangles.emplace_back(first, first + 3, first + 2);
    if (!scene.mesh.normals.empty()) scene.mesh.normals.resize(scene.mesh.positions.size());
    if (!scene.mesh.attributes.empty()) scene.mesh.attributes.resize(scene.mesh.positions.size());
    scene.parts.push_back(part);
  }

  /// Share of the receivers well within the plane that are not fully lit, as all of them are: texels of which
  /// the centre misses the plane know nothing of it.
  static double darkShare(const scene::Scene& scene, const std::string& technique, const Given& given) {
    const Rendered rendered = render(scene, technique, given, {96, 72});
    const glm::dmat4 toWorld = glm::inverse(scene.lights[0].toLightSpace());
    int receivers = 0, dark = 0;
    for (size_t i = 0; i < rendered.product.pixels(); ++i) {
      const float* receiver = rendered.receivers.data.data() + 4 * i;
      const glm::dvec3 at(toWorld * glm::dvec4(receiver[0], receiver[1], receiver[2], 1.0));
      if (receiver[3] < 0.0F || std::abs(at.z) > 1.0 || std::hypot(at.x, at.y) > 1.0) continue;
      ++receivers;
      dark += rendered.product.data[i] < 1.0F;
    }
    EXPECT_GT(receivers, 500);
    return double(dark) / receivers;
  }

  static double rootMeanSquare(const Image& a, const Image& b) {
    double sum = 0.0;
    for (size_t i = 0; i < a.data.size(); ++i) sum += std::pow(double(a.data[i]) - b.data[i], 2.0);
    return std::sqrt(sum / double(a.data.size()));
  }
};

// Each texel of a plane lies on it, so that no bias beyond the constant is needed, however wide the window.
TEST_F(PercentageCloser, TheReceiversPlaneLeavesALeaningPlaneLit) {
  for (const char* technique : {kHard, kPcf, kPcss})
    for (const double tilt : {0.0, 30.0, 60.0}) {
      const scene::Scene scene = leaningPlane(tilt, 2.0);
      const Given plane = {
          {"resolution", int64_t{128}}, {"bias", std::string("receiver_plane")}, {"bias.slope", 0.0}};
      EXPECT_EQ(darkShare(scene, technique, plane), 0.0) << technique << ", tilt " << tilt;
    }
  // The comparison is worth something: half of a plane's texels lie above it.
  EXPECT_GT(darkShare(leaningPlane(60.0, 2.0), kPcss,
                      {{"resolution", int64_t{128}}, {"bias", std::string("constant")}}),
            0.4);
}

// A plane that leans by an angle a along one axis of the map changes by w tan a over a texel of width w. A
// receiver moved by o w sin a along its normal lies o w tan a before the plane and is dark if its texel's
// centre is higher than that above it: the plane at the centre is up to w / 2 tan a higher, evenly
// distributed, so 1/2 - o of the receivers are dark. The offset goes by the larger of a texel's sides. The
// map is fitted to the plane, whose corners lie 4 -+ 1.5 sin a below the light: it spans tangents of 1.5 cos
// a (1 / 2.70 + 1 / 5.30) along the slope and 2 * 1.5 / 2.70 across it, 2.64 times as much, and so do its
// texels.
TEST_F(PercentageCloser, ANormalOffsetLeavesTheAcneThatTheoryHas) {
  // A light that is all but a point, so that no other texel than the receiver's own counts.
  const scene::Scene scene = leaningPlane(60.0, 0.005);
  for (const char* technique : {kHard, kPcss, "soft_shadows/peeled", "soft_shadows/hsm_traversal",
                                "soft_shadows/backprojection", "soft_shadows/bitmask"})
    for (const double offset : {0.0, 0.05, 0.1, 0.15, 0.25, 1.0}) {
      const double dark = darkShare(scene, technique,
                                    {{"resolution", int64_t{64}},
                                     {"bias", std::string("normal_offset")},
                                     {"bias.constant", 1e-6},
                                     {"bias.offset", offset}});
      // The sine of the angle of incidence differs from that of the plane by 13 % towards its ends, and
      // pixels sample the grid of texels, some 40 across the plane.
      EXPECT_NEAR(dark, std::max(0.5 - 2.64 * offset, 0.0), 0.06) << technique << ' ' << offset;
      if (offset > 0.22) {
        EXPECT_EQ(dark, 0.0) << technique << ' ' << offset;
      }
    }
}

TEST_F(PercentageCloser, AStoredBiasCoversATexelsOwnPlane) {
  // As stored: the change from the centre to the farthest corner, so that none of the texel's plane is below
  // its depth plus bias. A hard shadow reads no other texel.
  for (const double tilt : {30.0, 60.0})
    EXPECT_EQ(darkShare(leaningPlane(tilt, 0.4), kHard,
                        {{"resolution", int64_t{128}},
                         {"bias", std::string("stored")},
                         {"bias.constant", 1e-5},
                         {"bias.scale", 1.01}}),
              0.0)
        << tilt;
}

// Rays know the share of a light behind the plane without any map.
TEST_F(PercentageCloser, HidesTheLightBehindTheReceiversPlane) {
  const scene::Scene scene = leaningPlane(80.0, 24.0);
  const Image truth =
      render(scene, "soft_shadows/ray_traced", {{"samples", int64_t{1024}}}, {32, 24}).product;
  int cut = 0;
  for (const float value : truth.data) cut += value > 0.02F && value < 0.98F;
  ASSERT_GT(cut, 20);
  for (const char* technique : {kPcf, kPcss, "soft_shadows/hsm_traversal", "soft_shadows/peeled"}) {
    // Exact but for the rays' 1/32 of the light's width.
    const Image product =
        render(scene, technique, {{"bias", std::string("receiver_plane")}, {"resolution", int64_t{64}}},
               {32, 24})
            .product;
    EXPECT_LT(rootMeanSquare(product, truth), 0.01) << technique;
  }
}

// The plane leans by 70 degrees, so that from its middle, 4 m below the light of 9.6 m, light beyond 4 cot 70
// = 1.46 m lies behind it: 0.65 of the light is before it. A card at half of the height hides 0.58 of the
// light, all of it before the plane: 0.07 are left, where shares taken as independent would leave 0.27.
TEST_F(PercentageCloser, BlockersHideNothingOfTheLightBehindThePlane) {
  scene::Scene scene = leaningPlane(70.0, 24.0);
  addRectangle(scene, 2.0, {-2.3, -2.3}, {0.6, 2.3});
  scene::setStillCamera(scene, scene::orbitCamera(glm::dvec3(0.0), 5.0, -35.0, 10.0));  // below the card
  const Image truth =
      render(scene, "soft_shadows/ray_traced", {{"samples", int64_t{1024}}}, {64, 48}).product;
  const Given given = {{"search_taps", int64_t{32}}, {"filter_taps", int64_t{32}}};
  const Rendered pcss = render(scene, kPcss, given, {64, 48});
  const glm::dmat4 toWorld = glm::inverse(scene.lights[0].toLightSpace());
  int compared = 0;
  for (size_t i = 0; i < truth.pixels(); ++i) {
    const float* receiver = pcss.receivers.data.data() + 4 * i;
    const glm::dvec3 at(toWorld * glm::dvec4(receiver[0], receiver[1], receiver[2], 1.0));
    if (receiver[3] < 0.0F || glm::length(at) > 0.4) continue;
    ++compared;
    // The card's edges to a tap's width, 1/32 of the light's, on three sides, and the rays' as much again.
    EXPECT_NEAR(pcss.product.data[i], truth.data[i], 0.1) << i;
    EXPECT_NEAR(truth.data[i], 0.07, 0.15) << i;
  }
  EXPECT_GT(compared, 10);
}

TEST_F(PercentageCloser, SampledMapsLeaveALeaningPlaneLitWithoutSlope) {
  for (const double tilt : {30.0, 60.0}) {
    const Given plane = {{"samples", int64_t{16}},
                         {"resolution", int64_t{128}},
                         {"bias", std::string("receiver_plane")},
                         {"bias.slope", 0.0}};
    EXPECT_EQ(darkShare(leaningPlane(tilt, 2.0), "soft_shadows/sampled_light", plane), 0.0) << tilt;
    Given slope = plane;
    slope["bias"] = std::string("receiver_slope");
    EXPECT_GT(darkShare(leaningPlane(tilt, 2.0), "soft_shadows/sampled_light", slope), 0.4) << tilt;
  }
}

}  // namespace
}  // namespace limen::techniques
