// SPDX-License-Identifier: BSD-3-Clause
// Microrects as occluders against a brute-force twin in double precision: every microrect of a level is
// backprojected for every receiver, with no search area, no pyramid and no early exit. That the microrects
// are the right ones is tested with the frame's inputs.
#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/microrect_map.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

constexpr double kRectBias = 1e-4, kRectSlopeBias = 2.0, kRectMaxSlope = 10.0;
constexpr int kRectMap = 64;

struct RectTwin {
  Image depths;
  std::vector<uint32_t> extents;  // k_-x, k_-y, k_+x, k_+y; none at level 0
  int level;
  frame::LightFrustum frustum;
  glm::dvec2 lightSize;
  bool fills;

  double depthAt(int x, int y) const {
    return x < 0 || y < 0 ? double(frame::kEmptyDepth) : double(depths.at(x, y));
  }

  /// Calls `found(low, high)` for each microrect that blocks, in unit light coordinates, clamped to the
  /// light.
  template <class Found>
  void rects(const Image& receivers, int px, int py, Found found) const {
    const glm::dvec3 p(receivers.at(px, py, 0), receivers.at(px, py, 1), receivers.at(px, py, 2));
    const glm::dvec2 tangents = frustum.high - frustum.low;
    const double slope = std::min(double(receivers.at(px, py, 3)), kRectMaxSlope * p.z);
    const double limit = p.z - kRectBias * p.z -
                         kRectSlopeBias * slope * std::max(tangents.x, tangents.y) / kRectMap * (1 << level);
    const auto project = [&](int edge, double z, int axis) {
      const double t = frustum.low[axis] + tangents[axis] * edge / kRectMap;
      return (z * p.z * t - p[axis] * z) / (p.z - z) / lightSize[axis] + 0.5;
    };
    for (int y = 0; y < depths.height; ++y)
      for (int x = 0; x < depths.width; ++x) {
        const double z = depthAt(x, y);
        if (!(z < limit)) continue;
        glm::ivec2 first = glm::ivec2(x, y) << level, end = first + 1;
        if (level > 0) {
          const uint32_t* k = extents.data() + 4 * static_cast<size_t>(y * depths.width + x);
          first -= glm::ivec2(k[0], k[1]), end += glm::ivec2(k[2], k[3]);
        }
        glm::dvec2 low(project(first.x, z, 0), project(first.y, z, 1));
        const glm::dvec2 high(project(end.x, z, 0), project(end.y, z, 1));
        const double left = depthAt(x - 1, y), below = depthAt(x, y - 1);
        if (fills && left < limit) low.x = std::min(low.x, project(first.x, left, 0));
        if (fills && below < limit) low.y = std::min(low.y, project(first.y, below, 1));
        const glm::dvec2 a = glm::clamp(low, 0.0, 1.0), b = glm::clamp(high, 0.0, 1.0);
        if (a.x < b.x && a.y < b.y) found(a, b);
      }
  }

  double area(const Image& receivers, int x, int y) const {
    double sum = 0.0;
    rects(receivers, x, y, [&](glm::dvec2 a, glm::dvec2 b) { sum += (b.x - a.x) * (b.y - a.y); });
    return 1.0 - std::min(sum, 1.0);
  }

  /// 16 x 16 samples on a regular grid.
  double mask(const Image& receivers, int x, int y) const {
    std::array<bool, 256> covered{};
    rects(receivers, x, y, [&](glm::dvec2 a, glm::dvec2 b) {
      for (size_t bit = 0; bit < covered.size(); ++bit) {
        const glm::dvec2 s((double(bit % 16) + 0.5) / 16.0, (double(bit / 16) + 0.5) / 16.0);
        covered[bit] = covered[bit] || (a.x < s.x && s.x <= b.x && a.y < s.y && s.y <= b.y);
      }
    });
    return 1.0 - static_cast<double>(std::count(covered.begin(), covered.end(), true)) / 256.0;
  }
};

class Microrects : public TechniqueTest {
 protected:
  struct Compared {
    double largest = 0.0;
    int differing = 0, compared = 0, partly = 0;
  };

  static Compared compare(const scene::Scene& scene, bool masks, int level, const std::string& structure,
                          bool fills) {
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, {40, 30});
    const TechniqueInfo& info =
        TechniqueRegistry::instance().get(masks ? "soft_shadows/bitmask" : "soft_shadows/backprojection");
    Given given = {{"resolution", int64_t{kRectMap}},
                   {"occluders", std::string("microrects")},
                   {"levels", std::string("fixed")},
                   {"levels.level", int64_t{level}},
                   {"structure", structure},
                   {"occluders.gap_fill", std::string(fills ? "left_bottom" : "none")}};
    if (masks) given["pattern"] = std::string("regular_16");
    const auto made = info.make(ParameterValues(info.parameters, given));
    made->prepare(frame);
    frame.begin();
    made->render(frame);
    const frame::ShadowMapSettings settings{kRectMap};
    const auto& pyramid = frame.get<frame::MinMaxPyramid>(settings);
    const auto& rects = frame.get<frame::MicrorectMap>(frame::MicrorectSettings{settings}).levels();
    // Whether a point is in umbra is told by the finest level, whose texels block sooner than coarse ones
    // with their larger bias; gaps between them are taken for closed.
    const RectTwin finest{pyramid.minimum().read(), {}, 0, pyramid.frustum(), scene.lights[0].size, true};
    const RectTwin twin{level == 0 ? pyramid.minimum().read() : rects.depths().read(level - 1),
                        level == 0 ? std::vector<uint32_t>{} : rects.extents().readUint(level - 1),
                        level,
                        pyramid.frustum(),
                        scene.lights[0].size,
                        fills};
    const Image receivers = frame.get<frame::Receivers>().texture().read();
    frame.end();
    const Image product = made->product().read();
    Compared out;
    for (int y = 0; y < product.height; ++y)
      for (int x = 0; x < product.width; ++x) {
        if (receivers.at(x, y, 3) < 0.0F) continue;
        const double expected = masks ? twin.mask(receivers, x, y) : twin.area(receivers, x, y);
        if (product.at(x, y) == 0.0F && expected > 0.0) {
          EXPECT_LT(finest.mask(receivers, x, y), 0.2) << "dark by classification, yet not enclosed";
          continue;
        }
        const double error = std::abs(product.at(x, y) - expected);
        ++out.compared;
        out.partly += product.at(x, y) > 0.0F && product.at(x, y) < 1.0F;
        out.largest = std::max(out.largest, error);
        out.differing += error > (masks ? 1e-6 : 1e-3);
      }
    return out;
  }
};

TEST_F(Microrects, MasksHoldTheSamplesThatTheLevelsRectanglesCover) {
  for (const char* name : {"sphere_grid", "box_under_light", "two_boxes"}) {
    const scene::Scene scene = makeScene(name);
    for (const int level : {0, 1, 2, 4})
      for (const char* structure : {"hsm", "ysm"}) {
        const bool fills = level % 2 == 0;
        const Compared result = compare(scene, true, level, structure, fills);
        EXPECT_GT(result.partly, 20) << name << level;
        // A sample within float rounding of an edge may fall on either side, and with it the rest of its row.
        EXPECT_LE(result.largest, 16.0 / 256.0 + 1e-6) << name << ", level " << level << ", " << structure;
        EXPECT_LE(result.differing, result.compared / 50) << name << ", level " << level << ", " << structure;
      }
  }
}

TEST_F(Microrects, AreasAddUpHoweverMuchTheyOverlap) {
  for (const char* name : {"sphere_grid", "two_boxes"})
    for (const int level : {1, 3}) {
      // Light-space positions carry the rounding of the G-buffer; near contact k = z / (p_z - z) magnifies
      // it.
      const Compared result = compare(makeScene(name), false, level, "hsm", false);
      EXPECT_GT(result.partly, 20) << name;
      EXPECT_LE(result.differing, result.compared / 50)
          << name << ", level " << level << ": " << result.largest;
    }
}

TEST_F(Microrects, AtTheFinestLevelTheyAreMicropatches) {
  const scene::Scene scene = makeScene("sphere_grid");
  for (const char* technique : {"soft_shadows/backprojection", "soft_shadows/bitmask"})
    for (const char* fill : {"none", "left_bottom", "diagonal"}) {
      std::array<Image, 2> products;
      for (const bool rects : {false, true})
        products[rects] = render(scene, technique,
                                 {{"resolution", int64_t{64}},
                                  {"levels", std::string("fixed")},
                                  {"levels.level", int64_t{0}},
                                  {"occluders.gap_fill", std::string(fill)},
                                  {"occluders", std::string(rects ? "microrects" : "micropatches")}},
                                 {48, 36})
                              .product;
      EXPECT_EQ(products[0].data, products[1].data) << technique << ' ' << fill;
    }
}

TEST_F(Microrects, AMapOfOneTexelAndOneWithoutCastersHaveThem) {
  scene::Scene empty = makeScene("two_boxes");
  const scene::Part ground = empty.parts[0];
  ASSERT_TRUE(ground.receiverOnly);
  empty.parts.resize(1);
  empty.mesh.triangles.resize(ground.triangleCount);
  for (const char* technique : {"soft_shadows/backprojection", "soft_shadows/bitmask"}) {
    const Given rects = {{"occluders", std::string("microrects")},
                         {"levels", std::string("fixed")},
                         {"levels.level", int64_t{0}}};
    Given single = rects, coarse = rects;
    single["resolution"] = int64_t{1};
    coarse["resolution"] = int64_t{64};
    coarse["levels.level"] = int64_t{6};
    for (const float value : render(makeScene("two_boxes"), technique, single, {16, 12}).product.data)
      ASSERT_TRUE(value >= 0.0F && value <= 1.0F) << value;
    // A plane that nothing shadows, flat to the light's eye up to its bias at any level.
    for (const float value : render(empty, technique, coarse, {16, 12}).product.data)
      ASSERT_TRUE(value >= 0.0F && value <= 1.0F) << value;
  }
}

}  // namespace
}  // namespace limen::techniques
