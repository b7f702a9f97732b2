// SPDX-License-Identifier: BSD-3-Clause
// Bitmasks on lights that do not fill their rectangle: against the scene's own geometry sample by sample, and
// against the exact visible area of the light.
#include <cmath>

#include "experiments/base/error.h"
#include "renderer/techniques/soft_shadows/bitmask/light_samples.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

const std::vector<glm::dvec2> kArrow = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.5, 0.2}, {0.0, 1.0}};

class LightShapes : public TechniqueTest {
 protected:
  static scene::Scene shaped(const std::string& name, const std::string& shape, Given given = {}) {
    if (shape != "arrow") {
      given["light_shape"] = shape;
      return makeScene(name, given);
    }
    scene::Scene scene = makeScene(name, given);
    scene.lights[0].shape = scene::LightShape::Polygon;
    scene.lights[0].outline = kArrow;
    return scene;
  }

  /// Root of the mean square of the error over receivers.
  static double rmse(const Image& product, const Rendered& truth) {
    double sum = 0.0;
    int count = 0;
    for (size_t i = 0; i < product.pixels(); ++i) {
      if (truth.receivers.data[4 * i + 3] < 0.0F) continue;
      const double error = double(product.data[i]) - truth.product.data[i];
      sum += error * error;
      ++count;
    }
    return std::sqrt(sum / count);
  }
};

/// The half-plane hides the light's samples whose ray crosses its height at x < 0. Its edge lies on an edge
/// of the map's texels, so that what the map loses is rounding: samples whose ray passes the edge by less
/// than `margin` of the light may fall on either side. A table of rectangles rounds bounds to 1/128 as well.
TEST_F(LightShapes, OnlySamplesOnTheLightCount) {
  for (const char* shape : {"disc", "polygon", "arrow"})
    for (const char* pattern : {"regular_8", "regular_32", "jittered_16", "halton_256"}) {
      const std::string what = std::string(shape) + ", " + pattern;
      const scene::Scene scene = shaped("half_plane", shape);
      const scene::AreaLight& light = scene.lights[0];
      const Rendered result = render(
          scene, "soft_shadows/bitmask",
          {{"resolution", int64_t{64}}, {"budget.limit", int64_t{0}}, {"pattern", std::string(pattern)}},
          {40, 30});
      const double margin = isGridPattern(fromText<LightPattern>(pattern)) ? 2e-3 : 2e-3 + 0.5 / 128.0;
      const std::vector<glm::dvec2> samples = lightSamples(fromText<LightPattern>(pattern));
      int penumbra = 0;
      for (int y = 0; y < result.product.height; ++y)
        for (int x = 0; x < result.product.width; ++x) {
          if (result.receivers.at(x, y, 3) < 0.0F) continue;
          const glm::dvec3 p = light.centre + light.axisX * double(result.receivers.at(x, y, 0)) +
                               light.axisY * double(result.receivers.at(x, y, 1)) +
                               light.direction() * double(result.receivers.at(x, y, 2));
          if (std::abs(p.y) > 1e-3) continue;  // the card's own top
          int onLight = 0, surely = 0, perhaps = 0;
          for (const glm::dvec2 sample : samples) {
            if (!light.contains(sample)) continue;
            ++onLight;
            const glm::dvec3 to = light.point(sample);
            // Distance on the light between the sample and the edge as seen from p.
            const double atEdge = (1.0 - p.y) / (to.y - p.y);
            const double beyond = (p.x + atEdge * (to.x - p.x)) / atEdge / light.size.x;
            surely += beyond > margin;
            perhaps += beyond > -margin;
          }
          ASSERT_GT(onLight, 0);
          ASSERT_LT(onLight, static_cast<int>(samples.size()));
          const double low = double(surely) / onLight, high = double(perhaps) / onLight;
          EXPECT_GE(result.product.at(x, y), low - 1e-6) << what << " at " << x << ' ' << y;
          EXPECT_LE(result.product.at(x, y), high + 1e-6) << what << " at " << x << ' ' << y;
          penumbra += surely > 0 && perhaps < onLight;
        }
      EXPECT_GT(penumbra, 20) << what;
    }
}

/// What the map misjudges is an area on the light's rectangle; on a shape of share a of it the same area is
/// 1/a as large a share. To that come samples: 16 x 16 jittered ones know two edges to 2/32, and each half as
/// well again on average. Who takes the shape for its rectangle errs by far more.
TEST_F(LightShapes, VisibilityIsTheShapesOwn) {
  constexpr glm::ivec2 kSize{64, 48};
  const Given big = {{"light_size", 3.0}};
  const Given settings = {{"resolution", int64_t{256}}};
  const Rendered rectangle = render(makeScene("two_boxes", big), "soft_shadows/bitmask", settings, kSize);
  const double rectangleError =
      rmse(rectangle.product, render(makeScene("two_boxes", big), "soft_shadows/exact_union", {}, kSize));
  for (const char* shape : {"disc", "polygon", "arrow"}) {
    const scene::Scene scene = shaped("two_boxes", shape, big);
    const double share = scene.lights[0].area() / (scene.lights[0].size.x * scene.lights[0].size.y);
    const Rendered truth = render(scene, "soft_shadows/exact_union", {}, kSize);
    const Image product = render(scene, "soft_shadows/bitmask", settings, kSize).product;
    const double error = rmse(product, truth);
    EXPECT_LT(error, rectangleError / share + 1.0 / 64.0) << shape;
    EXPECT_LT(error, rmse(rectangle.product, truth)) << shape;
  }
}

TEST_F(LightShapes, ALightThatNoSampleHitsIsRefused) {
  scene::Scene scene = makeScene("half_plane");
  scene.lights[0].shape = scene::LightShape::Polygon;
  // Between the two middle columns of an 8 x 8 grid.
  scene.lights[0].outline = {{0.49, 0.0}, {0.51, 0.0}, {0.51, 1.0}, {0.49, 1.0}};
  try {
    render(scene, "soft_shadows/bitmask", {{"pattern", std::string("regular_8")}}, {8, 8});
    FAIL() << "rendered";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("none of the 64 light samples"), std::string::npos);
  }
}

}  // namespace
}  // namespace limen::techniques
