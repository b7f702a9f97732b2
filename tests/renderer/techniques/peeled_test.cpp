// SPDX-License-Identifier: BSD-3-Clause
// Peeled layers against a twin in double precision that looks at every texel of every layer, and the umbra
// that one layer loses.
#include <algorithm>
#include <cmath>

#include "tests/renderer/techniques/plane_share_twin.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

class PeeledTest : public TechniqueTest {
 protected:
  static constexpr int kSide = 64;

  /// `gradient`: of the receiver's plane; null: a bias by the slope.
  static double twin(const std::vector<Image>& layers, const frame::LightFrustum& frustum,
                     glm::dvec2 lightSize, glm::dvec3 p, double slope, const glm::dvec2* gradient) {
    const glm::dvec2 texel = (frustum.high - frustum.low) / double(kSide);
    const double limit = p.z * (1.0 - 1e-4) -
                         (gradient ? 0.0 : 2.0 * std::min(slope, 10.0 * p.z) * std::max(texel.x, texel.y));
    const auto blocks = [&](double z, int x, int y) {
      if (!(z < limit)) return false;
      if (!gradient) return true;
      const glm::dvec2 away = frustum.low + (glm::dvec2(x, y) + 0.5) * texel - glm::dvec2(p) / p.z;
      const double margin = std::min(glm::dot(glm::abs(*gradient), texel), 10.0 * std::max(texel.x, texel.y));
      return z < p.z / (1.0 + glm::dot(*gradient, away)) * (1.0 - 1e-4 - 0.5 * margin);
    };
    double area = 0.0;
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        double z = -1.0;
        for (const Image& layer : layers)
          if (blocks(layer.at(x, y), x, y)) z = std::max(z, double(layer.at(x, y)));
        if (z < 0.0) continue;
        const auto covered = [&](int index, int axis) {
          const auto toLight = [&](double u) {
            const double q = (frustum.low[axis] + u * texel[axis]) * z;  // where the texel's edge is at z
            return std::clamp((q * p.z - p[axis] * z) / (p.z - z) / lightSize[axis] + 0.5, 0.0, 1.0);
          };
          return std::max(toLight(index + 1) - toLight(index), 0.0);
        };
        area += covered(x, 0) * covered(y, 1);
      }
    return (gradient ? shareBeforePlane(*gradient, lightSize, p.z) : 1.0) * (1.0 - std::min(area, 1.0));
  }
};

TEST_F(PeeledTest, TakesTheFarthestLayerBeforeTheReceiver) {
  struct Case {
    std::string name;
    int layerCount;
    bool plane;
  };
  for (const auto& [name, layerCount, plane] : std::vector<Case>{{"two_boxes", 1, false},
                                                                 {"two_boxes", 3, false},
                                                                 {"sphere_grid", 4, false},
                                                                 {"two_boxes", 3, true},
                                                                 {"sphere_grid", 4, true},
                                                                 {"resting_sphere", 2, true}}) {
    // The light of the tilted plane is cut by it.
    const scene::Scene scene =
        name == "resting_sphere" ? makeScene(name, {{"tilt", 70.0}, {"light_size", 12.0}}) : makeScene(name);
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, {40, 30});
    const TechniqueInfo& info = TechniqueRegistry::instance().get("soft_shadows/peeled");
    Given given = {{"resolution", int64_t{kSide}}, {"layers", int64_t{layerCount}}};
    given["bias"] = std::string(plane ? "receiver_plane" : "receiver_slope");
    if (!plane) given["bias.slope"] = 2.0;
    const auto made = info.make(ParameterValues(info.parameters, given));
    made->prepare(frame);
    frame.begin();
    made->render(frame);
    std::vector<Image> layers;
    frame::LightFrustum frustum;
    for (int layer = 0; layer < layerCount; ++layer) {
      frame::ShadowMapSettings settings;
      settings.resolution = kSide;
      settings.layer = layer;
      const auto& map = frame.get<frame::ShadowMap>(settings);
      layers.push_back(map.texture().read());
      frustum = map.frustum();
    }
    const Image receivers = frame.get<frame::Receivers>().texture().read(),
                planes = frame.get<frame::Receivers>().planes().read();
    frame.end();
    const Image product = made->product().read();
    int compared = 0, differing = 0, partly = 0;
    for (int y = 0; y < product.height; ++y)
      for (int x = 0; x < product.width; ++x) {
        if (receivers.at(x, y, 3) < 0.0F) continue;
        const glm::dvec3 p(receivers.at(x, y, 0), receivers.at(x, y, 1), receivers.at(x, y, 2));
        const glm::dvec2 gradient(planes.at(x, y, 0), planes.at(x, y, 1));
        const double expected = twin(layers, frustum, scene.lights[0].size, p, receivers.at(x, y, 3),
                                     plane ? &gradient : nullptr);
        ++compared;
        partly += expected > 0.0 && expected < 1.0;
        // Light-space positions carry the rounding of the G-buffer; near contact it is magnified.
        differing += !(std::abs(double(product.at(x, y)) - expected) <= 1e-3);
      }
    EXPECT_GT(partly, 50) << name;
    EXPECT_LE(differing, compared / 100)
        << name << " " << layerCount << ": " << differing << " of " << compared;
  }
}

TEST_F(PeeledTest, SecondLayerRestoresTheUmbraBelowAHoveringBox) {
  // As in the test of scattering: from the ground within 1/3 m of the middle the underside, which the second
  // layer holds, hides all of the light, and the top alone leaves 0.36. Half a texel of the fitted map at the
  // rim of the top is thrown to 1.6 (0.5 / 62) m of the 2 m, on both sides of both axes.
  const scene::Scene scene = makeScene("box_under_light", {{"clearance", 0.8}, {"box_height", 1.2}});
  const glm::dmat4 fromLight = glm::inverse(scene.lights[0].toLightSpace());
  // Cells of one surface leave out nothing between them.
  for (const auto& [layers, division] :
       {std::pair(int64_t{1}, "texels"), {int64_t{2}, "texels"}, {int64_t{2}, "cells"}}) {
    const Rendered rendered = render(
        scene, "soft_shadows/peeled",
        {{"resolution", int64_t{kSide}}, {"layers", layers}, {"division", std::string(division)}}, {64, 48});
    int umbra = 0;
    for (size_t i = 0; i < rendered.product.pixels(); ++i) {
      const float* receiver = rendered.receivers.data.data() + 4 * i;
      if (receiver[3] < 0.0F) continue;
      const glm::dvec3 at(fromLight * glm::dvec4(receiver[0], receiver[1], receiver[2], 1.0));
      if (at.y > 0.01 || std::max(std::abs(at.x), std::abs(at.z)) > 0.3) continue;
      ++umbra;
      if (layers == 1)
        EXPECT_NEAR(rendered.product.data[i], 0.36, 0.03);
      else
        EXPECT_LT(rendered.product.data[i], 1e-3F);
    }
    EXPECT_GT(umbra, 10);
  }
}

/// Without a limit every cell is one texel; with one there are no more than it allows, and more of them err
/// less. The search areas of these scenes have up to some 20 x 20 texels.
TEST_F(PeeledTest, CellsOfABudgetApproachTheTexels) {
  for (const char* name : {"two_boxes", "sphere_grid"}) {
    const scene::Scene scene = makeScene(name);
    const auto of = [&](Given given) {
      given.insert({{"resolution", int64_t{256}}, {"layers", int64_t{2}}});
      return render(scene, "soft_shadows/peeled", given, {61, 45}, true);
    };
    const auto cells = [&](int64_t budget, double share) {
      return of({{"division", std::string("cells")},
                 {"division.budget", budget},
                 {"division.share", share},
                 {"division.least_width", 0.0}});
    };
    const Rendered texels = of({}), all = cells(0, 0.5), quarter = cells(64, 0.25), whole = cells(64, 1.0);
    const auto meanSquare = [&](const Rendered& other) {
      double sum = 0.0;
      for (size_t i = 0; i < texels.product.data.size(); ++i)
        sum += std::pow(double(other.product.data[i]) - double(texels.product.data[i]), 2);
      return sum / static_cast<double>(texels.product.data.size());
    };
    // A bound of an area may round to the other side of a texel's edge.
    EXPECT_LT(meanSquare(all), 1e-8) << name;
    EXPECT_NEAR(all.counter("micro_occluders_per_px"), texels.counter("micro_occluders_per_px"), 1e-3)
        << name;
    EXPECT_LE(quarter.counter("micro_occluders_per_px"), 16.0) << name;
    EXPECT_LE(whole.counter("micro_occluders_per_px"), 64.0) << name;
    EXPECT_GT(meanSquare(quarter), meanSquare(whole)) << name;
    EXPECT_GT(meanSquare(whole), 0.0) << name;
  }
}

}  // namespace
}  // namespace limen::techniques
