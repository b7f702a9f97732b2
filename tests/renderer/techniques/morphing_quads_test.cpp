// SPDX-License-Identifier: BSD-3-Clause
// Microquads that move between two levels, against a brute-force twin in double precision, and what that does
// to visibility as the level goes up in small steps.
#include <algorithm>
#include <cmath>

#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

constexpr double kMorphBias = 1e-4, kMorphSlopeBias = 0.5, kMorphMaxSlope = 10.0;
constexpr int kMorphMap = 64;

/// Twin of one receiver: cells that block, and the visibility that they leave.
struct Morphed {
  double visibility = 1.0;
  std::vector<int> cells;
};

class MorphingQuads : public TechniqueTest {
 protected:
  static Given atLevel(double level) {
    return {{"resolution", int64_t{kMorphMap}},
            {"bias", std::string("receiver_slope")},
            {"bias.slope", kMorphSlopeBias},
            {"occluders", std::string("morphing_microquads")},
            {"occluders.level", level}};
  }

  struct Pyramid {
    std::vector<Image> levels;
    frame::LightFrustum frustum;
  };

  static Pyramid pyramidOf(const scene::Scene& scene) {
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, {8, 8});
    frame.begin();
    const auto& pyramid = frame.get<frame::MinMaxPyramid>(frame::ShadowMapSettings{kMorphMap});
    Pyramid out{{}, pyramid.frustum()};
    for (int level = 0; level < pyramid.levels(); ++level)
      out.levels.push_back(pyramid.minimum().read(level));
    frame.end();
    return out;
  }

  static Morphed twin(const Pyramid& pyramid, const scene::Scene& scene, const float* receiver,
                      double level) {
    const int base = static_cast<int>(level);
    const double way = level - base;
    const glm::dvec3 p(receiver[0], receiver[1], receiver[2]);
    const glm::dvec2 tangents = pyramid.frustum.high - pyramid.frustum.low;
    const double slope = std::min(double(receiver[3]), kMorphMaxSlope * p.z);
    const double texel = std::max(tangents.x, tangents.y) / kMorphMap * (1 << base) * (1.0 + way);
    const double limit = p.z - kMorphBias * p.z - kMorphSlopeBias * slope * texel;
    const Image &fine = pyramid.levels[size_t(base)], &coarse = pyramid.levels[size_t(base) + 1];
    Morphed out;
    double hidden = 0.0;
    for (int y = 0; y + 1 < fine.height; ++y)
      for (int x = 0; x + 1 < fine.width; ++x) {
        std::vector<glm::dvec2> corners;
        for (const glm::ivec2 at : {glm::ivec2(x, y), {x + 1, y}, {x + 1, y + 1}, {x, y + 1}}) {
          const double z = 1.0 / ((1.0 - way) / fine.at(at.x, at.y) + way / coarse.at(at.x / 2, at.y / 2));
          if (!(z < limit)) break;
          const glm::dvec2 own = glm::dvec2(at) + 0.5, parents = 2.0 * glm::dvec2(at / 2) + 1.0;
          const glm::dvec2 tangent =
              pyramid.frustum.low + tangents * ((1.0 - way) * own + way * parents) / double(fine.width);
          const glm::dvec2 s = z / (p.z - z) * (p.z * tangent - glm::dvec2(p)) / scene.lights[0].size + 0.5;
          corners.push_back(glm::clamp(s, 0.0, 1.0));
        }
        if (corners.size() < 4) continue;
        const glm::dvec2 ac = corners[2] - corners[0], bd = corners[3] - corners[1];
        const double area = 0.5 * std::abs(ac.x * bd.y - ac.y * bd.x);
        if (area > 0.0) out.cells.push_back(y * fine.width + x);
        hidden += area;
      }
    out.visibility = 1.0 - std::min(hidden, 1.0);
    return out;
  }
};

TEST_F(MorphingQuads, HideTheSumOfTheMovedQuadsAreas) {
  for (const char* name : {"sphere_grid", "two_boxes"}) {
    const scene::Scene scene = makeScene(name, {{"light_size", 2.0}});
    const Pyramid pyramid = pyramidOf(scene);
    for (const double level : {0.0, 0.375, 1.75}) {
      const Rendered rendered = render(scene, "soft_shadows/backprojection", atLevel(level), {40, 30});
      int compared = 0, partly = 0, differing = 0;
      for (size_t i = 0; i < rendered.product.pixels(); ++i) {
        const float* receiver = rendered.receivers.data.data() + 4 * i;
        if (receiver[3] < 0.0F) continue;
        const double value = rendered.product.data[i];
        ++compared;
        partly += value > 0.0 && value < 1.0;
        // Light-space positions carry the rounding of the G-buffer; near contact it is magnified.
        differing += std::abs(value - twin(pyramid, scene, receiver, level).visibility) > 1e-3;
      }
      EXPECT_GT(partly, 50) << name << " at " << level;
      EXPECT_LE(differing, compared / 50) << name << " at " << level;
    }
  }
}

TEST_F(MorphingQuads, AtAWholeLevelTheyAreMicroquads) {
  const scene::Scene scene = makeScene("sphere_grid");
  for (const int level : {0, 2}) {
    const Image moved = render(scene, "soft_shadows/backprojection", atLevel(level), {40, 30}).product;
    const Image still = render(scene, "soft_shadows/backprojection",
                               {{"resolution", int64_t{kMorphMap}},
                                {"bias", std::string("receiver_slope")},
                                {"bias.slope", kMorphSlopeBias},
                                {"occluders", std::string("microquads")},
                                {"levels", std::string("fixed")},
                                {"levels.level", int64_t{level}}},
                               {40, 30})
                            .product;
    int differing = 0;
    for (size_t i = 0; i < moved.pixels(); ++i) differing += std::abs(moved.data[i] - still.data[i]) > 1e-4F;
    // The searches round their areas to other texels; what is told to be umbra by one may be gathered by the
    // other.
    EXPECT_LE(differing, static_cast<int>(moved.pixels()) / 100) << level;
  }
}

// Blending the visibilities of both levels steps by their difference times the step of the level, 1/64 at
// most. Moving the vertices steps by whatever a quad hides the moment one of its vertices passes the
// receiver's depth.
TEST_F(MorphingQuads, PopWhereAVertexPassesTheReceiver) {
  constexpr int kSteps = 64;
  const scene::Scene scene = makeScene("two_boxes", {{"light_size", 2.0}});
  const Pyramid pyramid = pyramidOf(scene);
  Rendered last = render(scene, "soft_shadows/backprojection", atLevel(1.0), {32, 24});
  double largest = 0.0, before = 0.0;
  size_t where = 0;
  for (int step = 1; step < kSteps; ++step) {
    const double level = 1.0 + double(step) / kSteps;
    Rendered next = render(scene, "soft_shadows/backprojection", atLevel(level), {32, 24});
    for (size_t i = 0; i < next.product.pixels(); ++i) {
      const double jump = std::abs(next.product.data[i] - last.product.data[i]);
      if (jump > largest) largest = jump, before = level - 1.0 / kSteps, where = i;
    }
    last = std::move(next);
  }
  RecordProperty("largest_step", std::to_string(largest));
  EXPECT_GT(largest, 4.0 / kSteps);
  // It is not the mesh that moves fast: cells come or go between the two levels.
  const float* receiver = last.receivers.data.data() + 4 * where;
  const Morphed a = twin(pyramid, scene, receiver, before),
                b = twin(pyramid, scene, receiver, before + 1.0 / kSteps);
  EXPECT_NE(a.cells, b.cells);
  EXPECT_NEAR(std::abs(a.visibility - b.visibility), largest, 0.02);
}

}  // namespace
}  // namespace limen::techniques
