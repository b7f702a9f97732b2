// SPDX-License-Identifier: BSD-3-Clause
// Microrects against a twin that is written from the definition, and their invariants on what the shader
// made.
#include "renderer/frame/microrect_map.h"

#include <epoxy/gl.h>

#include <random>

#include "renderer/frame/frame_bindings.h"
#include "tests/renderer/frame/brute_force.h"
#include "tests/renderer/frame/microrect_twin.h"
#include "tests/renderer/gl/gl_fixture.h"

namespace limen::frame {
namespace {

class MicrorectTest : public gl::GlTest {
 protected:
  struct Made {
    std::vector<Image> depths;                   // of levels 1 and up
    std::vector<std::vector<uint32_t>> extents;  // four a microrect
  };

  static Made build(const Image& map, MergeRule rule) {
    const gl::Texture minimum(gl::Format::R32F, {map.width, map.height});
    minimum.write(map);
    const MicrorectLevels levels(context(), ShadowMapSettings{map.width}, rule);
    levels.build(minimum);
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    Made out;
    for (int i = 0; i < levels.levels(); ++i) {
      out.depths.push_back(levels.depths().read(i));
      out.extents.push_back(levels.extents().readUint(i));
    }
    return out;
  }

  static std::vector<MergeRule> rules() {
    std::vector<MergeRule> out;
    for (const MergeMetric metric : {MergeMetric::Absolute, MergeMetric::Relative})
      for (const DiagonalMerge diagonal : {DiagonalMerge::Contained, DiagonalMerge::Nearest})
        out.push_back({metric, diagonal});
    return out;
  }

  static TwinRect rectOf(const Made& made, int level, int x, int y) {
    const Image& depths = made.depths[static_cast<size_t>(level - 1)];
    const uint32_t* k =
        made.extents[static_cast<size_t>(level - 1)].data() + 4 * static_cast<size_t>(y * depths.width + x);
    const glm::ivec2 reference = glm::ivec2(x, y) << level;
    return {reference - glm::ivec2(k[0], k[1]), reference + glm::ivec2(k[2], k[3]), depths.at(x, y)};
  }

  /// Maps that leave choices open (ties), force them, or offer none that is any good.
  static std::vector<std::pair<std::string, Image>> maps(int side) {
    std::mt19937 engine(7);
    std::uniform_real_distribution<float> uniform(1.0F, 9.0F);
    const auto filled = [&](auto value) {
      Image map(side, side, 1);
      for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) map.at(x, y) = value(x, y);
      return map;
    };
    return {
        {"random", filled([&](int, int) { return uniform(engine); })},
        {"few depths", filled([&](int, int) { return std::floor(uniform(engine) / 3.0F) + 1.0F; })},
        {"two depths", filled([&](int, int) { return uniform(engine) < 5.0F ? 2.0F : 3.0F; })},
        {"one depth", filled([](int, int) { return 4.0F; })},
        {"empty", filled([](int, int) { return kEmptyDepth; })},
        {"half empty", filled([&](int, int) {
           const float z = uniform(engine);
           return z < 5.0F ? z : kEmptyDepth;
         })},
        {"chequered", filled([](int x, int y) { return (x + y) % 2 ? 2.0F : 7.0F; })},
        {"ramp", filled([](int x, int y) { return 1.0F + static_cast<float>(3 * x + 2 * y); })},
        {"edge", filled([&](int x, int y) { return 3 * x > side + y ? 2.0F : 8.0F; })},
        {"huge and tiny", filled([&](int x, int) { return uniform(engine) * (x % 3 ? 1e-20F : 1e20F); })}};
  }
};

TEST_F(MicrorectTest, EveryLevelIsTheDefinitions) {
  for (const int side : {1, 2, 4, 8, 32, 128})
    for (const auto& [name, map] : maps(side))
      for (const MergeRule rule : rules()) {
        // Products of depths that far apart leave float's range, and with it the definition.
        if (name == "huge and tiny" && rule.metric == MergeMetric::Relative) continue;
        const Made made = build(map, rule);
        MicrorectTwin twin(map);
        for (int level = 1; side >> level > 0; ++level) {
          twin.coarsen(rule);
          for (int y = 0; y < twin.side(); ++y)
            for (int x = 0; x < twin.side(); ++x) {
              const TwinRect rect = rectOf(made, level, x, y), expected = twin.at(x, y);
              ASSERT_TRUE(rect.low == expected.low && rect.high == expected.high && rect.z == expected.z)
                  << name << " of " << side << ", level " << level << " at " << x << ' ' << y << ": ["
                  << rect.low.x << ' ' << rect.low.y << ' ' << rect.high.x << ' ' << rect.high.y << "] "
                  << rect.z;
            }
        }
      }
}

TEST_F(MicrorectTest, ExtentsHoldTheirOwnReferenceAloneAndAllTexelsAreRepresented) {
  for (const int side : {2, 16, 128})
    for (const auto& [name, map] : maps(side))
      for (const MergeRule rule : rules()) {
        const Made made = build(map, rule);
        for (int level = 1; side >> level > 0; ++level) {
          Image nearest(side, side, 1, std::numeric_limits<float>::infinity());
          for (int y = 0; y < side >> level; ++y)
            for (int x = 0; x < side >> level; ++x) {
              const TwinRect rect = rectOf(made, level, x, y);
              const glm::ivec2 reference = glm::ivec2(x, y) << level, step(1 << level);
              // Extents are unsigned, so that its own reference is inside; the neighbours' are not.
              ASSERT_TRUE(glm::all(glm::greaterThan(rect.low, reference - step))) << name;
              ASSERT_TRUE(glm::all(glm::lessThan(rect.high, reference + step))) << name;
              ASSERT_TRUE(glm::all(glm::greaterThanEqual(rect.low, glm::ivec2(0)))) << name;
              ASSERT_TRUE(glm::all(glm::lessThan(rect.high, glm::ivec2(side)))) << name;
              bool attained = false;
              for (int v = rect.low.y; v <= rect.high.y; ++v)
                for (int u = rect.low.x; u <= rect.high.x; ++u) {
                  attained = attained || map.at(u, v) == rect.z;
                  nearest.at(u, v) = std::min(nearest.at(u, v), rect.z);
                }
              ASSERT_TRUE(attained) << name << ": a depth that no texel has";
            }
          // Whatever blocks at level 0 is within a microrect that blocks.
          for (size_t i = 0; i < map.pixels(); ++i)
            ASSERT_LE(nearest.data[i], map.data[i]) << name << " of " << side << ", level " << level;
        }
      }
}

TEST_F(MicrorectTest, AnEdgeStaysWhereItIsAndAMinimumPyramidMovesIt) {
  // A card over a ground: columns 5 to 10 of 16. At level 1 odd column 5 goes to column 6 (depth equal), and
  // odd column 11 to column 12: no microrect holds texels of both. Blocks of the pyramid do, from 4 to 5 and
  // 10 to 11.
  Image map(16, 16, 1, 8.0F);
  for (int y = 0; y < 16; ++y)
    for (int x = 5; x <= 10; ++x) map.at(x, y) = 3.0F;
  const Made made = build(map, MergeRule{});
  int near = 0;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      const TwinRect rect = rectOf(made, 1, x, y);
      if (rect.z != 3.0F) continue;
      ++near;
      EXPECT_GE(rect.low.x, 5);
      EXPECT_LE(rect.high.x, 10);
    }
  EXPECT_EQ(near, 3 * 8);
}

TEST_F(MicrorectTest, TheMapOfASceneIsTheTwinsOfItsDepths) {
  const scene::Scene scene = builtScene("sphere_grid");
  const GpuScene gpuScene(scene);
  Frame frame(context(), scene, gpuScene, {8, 8});
  frame.begin();
  const ShadowMapSettings settings{64};
  MicrorectTwin twin(frame.get<ShadowMap>(settings).texture().read());
  const MicrorectLevels& levels = frame.get<MicrorectMap>(MicrorectSettings{settings}).levels();
  frame.end();
  for (int level = 1; level <= 6; ++level) {
    twin.coarsen(MergeRule{});
    const Image depths = levels.depths().read(level - 1);
    ASSERT_EQ(depths.width, twin.side());
    for (int y = 0; y < twin.side(); ++y)
      for (int x = 0; x < twin.side(); ++x) ASSERT_EQ(depths.at(x, y), twin.at(x, y).z) << level;
  }
  EXPECT_EQ(levels.bytes(), 12 * (32 * 32 + 16 * 16 + 8 * 8 + 4 * 4 + 2 * 2 + 1) + 8 * 32 * 32);
}

}  // namespace
}  // namespace limen::frame
