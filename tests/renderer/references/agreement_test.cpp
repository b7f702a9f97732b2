// SPDX-License-Identifier: BSD-3-Clause
// References against one another: they share the receiver points and nothing else.
#include <algorithm>
#include <cmath>

#include "renderer/frame/shadow_map.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "tests/renderer/gl/gl_fixture.h"
#include "tests/renderer/references/render_reference.h"

namespace limen::references {
namespace {

struct Comparison {
  size_t receivers = 0, penumbra = 0;
  double largest = 0.0, mean = 0.0, within = 0.0;  ///< share of receivers within the bound
};

Comparison compare(const Rendered& test, const Rendered& reference, double bound) {
  Comparison out;
  for (size_t i = 0; i < test.visibility.pixels(); ++i) {
    if (!test.isReceiver(i)) continue;
    const double difference = double(test.visibility.data[i]) - double(reference.visibility.data[i]);
    ++out.receivers;
    out.penumbra += reference.visibility.data[i] > 0.0F && reference.visibility.data[i] < 1.0F;
    out.largest = std::max(out.largest, std::abs(difference));
    out.mean += difference;
    out.within += std::abs(difference) <= bound;
  }
  out.mean /= double(std::max<size_t>(out.receivers, 1));
  out.within /= double(std::max<size_t>(out.receivers, 1));
  return out;
}

/// Vertical and horizontal cards that touch the ground, one of them coplanar with it.
scene::Scene touchingCards() {
  scene::Scene scene;
  scene::addGround(scene, 6.0);
  scene::Mesh cards = scene::card({0.0, 0.25, 0.0}, {0.5, 0.0, 0.0}, {0.0, 0.25, 0.0});
  scene::append(cards, scene::card({0.6, 0.0, 0.6}, {0.0, 0.0, 0.2}, {0.2, 0.0, 0.0}));
  scene::append(cards, scene::card({-0.6, 0.1, 0.4}, {0.0, 0.0, 0.2}, {0.2, 0.1, 0.0}));
  scene::addPart(scene, "cards", cards, glm::vec3(0.5F));
  scene.lights = {scene::lightTowards({-0.5, 2.0, 1.0}, {0.0, 0.0, 0.0}, {0.5, 0.4})};
  scene::setStillCamera(scene, scene::orbitCamera({0.0, 0.1, 0.0}, 3.5, 20.0, 35.0));
  return scene;
}

class Agreement : public gl::GlTest {
 protected:
  /// Hoeffding: with N rays a pixel leaves its bound with probability 1e-3 or less, any of M pixels leaves
  /// sqrt(ln(2 M / 1e-3) / 2 N), and the mean over all leaves sqrt(ln(2 / 1e-3) / (2 N M)); rounding aside.
  void expectRaysAgreeWithUnion(const scene::Scene& scene, const std::string& name) {
    constexpr int64_t kRays = 256;
    const Rendered exact = renderReference(context(), scene, "soft_shadows/exact_union", {}, {48, 48});
    for (const char* pattern : {"stratified", "random"}) {
      const Rendered traced = renderReference(context(), scene, "soft_shadows/ray_traced",
                                              {{"samples", kRays}, {"pattern", pattern}}, {48, 48});
      const Comparison result = compare(traced, exact, traced.errorBound);
      const auto receivers = double(result.receivers);
      EXPECT_GT(result.receivers, 300U) << name;
      EXPECT_GT(result.penumbra, 10U) << name;
      EXPECT_GE(result.within, 0.9975) << name << ' ' << pattern;
      EXPECT_LE(result.largest, std::sqrt(std::log(2e3 * receivers) / (2.0 * kRays)))
          << name << ' ' << pattern;
      EXPECT_LE(std::abs(result.mean), std::sqrt(std::log(2e3) / (2.0 * kRays * receivers)))
          << name << ' ' << pattern;
    }
  }
};

TEST_F(Agreement, RaysAgreeWithTheExactUnionOnEveryCheapScene) {
  for (const char* name :
       {"box_under_light", "two_boxes", "pole", "card_stack", "half_plane", "parallel_rectangle", "comb",
        "columns_hall", "cornell_box", "two_colour_light", "degenerate_soup"})
    expectRaysAgreeWithUnion(builtScene(name), name);
  expectRaysAgreeWithUnion(builtScene("sphere_grid", {{"tessellation", int64_t{6}}}), "sphere_grid");
  expectRaysAgreeWithUnion(builtScene("foliage", {{"leaves", int64_t{500}}}), "foliage");
}

TEST_F(Agreement, RaysAgreeWithTheExactUnionForEveryShapeOfLight) {
  for (const char* shape : {"rectangle", "disc", "polygon"})
    expectRaysAgreeWithUnion(builtScene("two_boxes", {{"light_shape", shape}, {"light_size", 3.0}}), shape);
  scene::Scene concave = builtScene("two_boxes", {{"light_size", 3.0}});
  concave.lights[0].shape = scene::LightShape::Polygon;
  concave.lights[0].outline = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.5, 0.2}, {0.0, 1.0}};
  expectRaysAgreeWithUnion(concave, "concave");
}

TEST_F(Agreement, RaysAgreeWithTheExactUnionAtEveryScaleAndPlace) {
  for (const auto& [scale, offset] : {std::pair(1e-4, 0.0), {1e4, 0.0}, {1.0, 1e4}})
    expectRaysAgreeWithUnion(builtScene("two_boxes", {{"scale", scale}, {"offset", offset}}),
                             "scaled or moved");
}

TEST_F(Agreement, RaysAgreeWithTheExactUnionWhereCardsTouchTheGround) {
  expectRaysAgreeWithUnion(touchingCards(), "touching cards");
}

TEST_F(Agreement, RaysAgreeWithTheExactUnionUnderALightThatTrianglesCross) {
  scene::Scene scene = builtScene("two_boxes", {{"light_size", 3.0}});
  // A card through the light's middle, half of it behind the light, and one beside the receivers that passes
  // through the ground: both reach over the depths where projecting vertices would divide by zero.
  const scene::AreaLight& light = scene.lights[0];
  scene::Mesh cards = scene::card(light.centre, 0.2 * light.direction(), 0.3 * light.axisX);
  scene::append(cards, scene::card({0.9, 0.0, 0.2}, {0.0, 0.5, 0.0}, {0.0, 0.0, 0.3}));
  scene::addPart(scene, "crossing", cards, glm::vec3(0.5F));
  expectRaysAgreeWithUnion(scene, "crossing cards");
}

/// Maps against rays. With S x S maps, an edge across the light costs at most 2 / S (see the reference's own
/// bound) and two edges are usual behind convex bodies. A map's shadow boundary is off by up to a texel,
/// which matters
///  - in a wide penumbra as a shift of the edge on the light, in each of S^2 maps another way: inside the 2 /
///  S;
///  - where the penumbra is narrower than a pixel as a pixel on the wrong side: the share of steep pixels
///  (whose
///    neighbours differ by more than half) times the share of a pixel that a band of two texels' diagonals
///    covers.
/// The mean has no sampling error to speak of; what could move all edges one way is at most half a cell, 1 /
/// (2 S), in the share of pixels with a penumbra or a steep edge.
TEST_F(Agreement, MapsAgreeWithRaysOnTheSphereGrid) {
  constexpr int kPixels = 96, kSide = 16, kResolution = 512;
  const scene::Scene scene = builtScene("sphere_grid");
  const Rendered traced = renderReference(context(), scene, "soft_shadows/ray_traced",
                                          {{"samples", int64_t{1024}}}, {kPixels, kPixels});
  const Rendered maps = renderReference(
      context(), scene, "soft_shadows/sampled_light",
      {{"samples", int64_t{kSide * kSide}}, {"resolution", int64_t{kResolution}}}, {kPixels, kPixels});
  size_t steep = 0;
  for (int y = 1; y + 1 < kPixels; ++y)
    for (int x = 1; x + 1 < kPixels; ++x) {
      const float here = traced.visibility.at(x, y);
      steep += std::max({std::abs(traced.visibility.at(x + 1, y) - here),
                         std::abs(traced.visibility.at(x - 1, y) - here),
                         std::abs(traced.visibility.at(x, y + 1) - here),
                         std::abs(traced.visibility.at(x, y - 1) - here)}) > 0.5F;
    }
  const frame::LightFrustum frustum = frame::LightCasters(scene).fit(glm::dvec2(0.0), kResolution);
  const scene::Camera camera = scene.camera.at(0.0);
  const double pixelWidth = 2.0 * std::tan(0.5 * glm::radians(camera.verticalFovDeg)) / kPixels *
                            glm::length(camera.eye - camera.target);
  const double texelWidth = std::max(frustum.high.x - frustum.low.x, frustum.high.y - frustum.low.y) /
                            kResolution * glm::length(scene.lights[0].centre - camera.target);
  const Comparison result = compare(maps, traced, 2.0 * 2.0 / kSide + traced.errorBound);
  const double steepShare = double(steep) / double(result.receivers);
  EXPECT_LE(1.0 - result.within, steepShare * 2.0 * std::sqrt(2.0) * texelWidth / pixelWidth);
  EXPECT_LE(std::abs(result.mean),
            0.5 / kSide * (double(result.penumbra) / double(result.receivers) + steepShare));
  RecordProperty("share_outside", std::to_string(1.0 - result.within));
  RecordProperty("mean_difference", std::to_string(result.mean));
}

}  // namespace
}  // namespace limen::references
