// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/multi_scale_map.h"

#include <random>

#include "experiments/base/error.h"
#include "renderer/frame/frame_bindings.h"
#include "tests/renderer/frame/brute_force.h"
#include "tests/renderer/frame/depth_pyramid.h"
#include "tests/renderer/gl/gl_fixture.h"

namespace limen::frame {
namespace {

class MultiScaleMapTest : public gl::GlTest {};

// Figure 4.5 of Schwarz 2009: a map of 8 x 8 texels and the minima of its three layers, as printed side by
// side; the top row is y = 7.
constexpr int kPrinted[8][32] = {{54, 64, 67, 45, 64, 39, 24, 97, 9, 9, 13, 45, 45, 32, 16, 16,
                                  9,  9,  9,  13, 8,  8,  8,  8,  8, 5, 5,  5,  5,  5,  5,  5},
                                 {9, 13, 82, 81, 75, 32, 16, 68, 9, 9, 13, 81, 75, 8, 8, 16,
                                  8, 8,  8,  8,  8,  8,  8,  8,  3, 3, 3,  3,  3,  3, 3, 3},
                                 {90, 24, 90, 92, 88, 8, 20, 66, 79, 8, 8, 68, 61, 8, 8, 11,
                                  8,  8,  8,  5,  5,  5, 5,  8,  3,  3, 3, 3,  3,  3, 3, 3},
                                 {79, 8, 70, 68, 61, 45, 92, 11, 76, 8, 8, 57, 5, 5, 40, 11,
                                  8,  8, 3,  3,  3,  3,  5,  8,  2,  2, 2, 2,  1, 1, 1,  1},
                                 {76, 74, 57, 91, 5, 95, 40, 46, 65, 65, 17, 3, 3, 5, 40, 40,
                                  8,  8,  3,  3,  3, 3,  5,  11, 2,  2,  2,  2, 1, 1, 1,  1},
                                 {65, 93, 17, 3, 78, 87, 85, 58, 17, 17, 17, 3, 3, 48, 22, 22,
                                  17, 2,  2,  2, 2,  3,  1,  1,  2,  2,  2,  2, 1, 1,  1,  1},
                                 {17, 55, 63, 41, 48, 94, 22, 80, 17, 17, 2, 2, 35, 35, 22, 1,
                                  17, 2,  2,  2,  2,  3,  1,  1,  2,  2,  2, 2, 1,  1,  1,  1},
                                 {26, 73, 2, 91, 35, 89, 30, 1, 26, 26, 2, 2, 35, 35, 30, 1,
                                  17, 2,  2, 2,  2,  22, 1,  1, 2,  2,  2, 2, 1,  1,  1,  1}};

TEST_F(MultiScaleMapTest, MinimaAreThoseOfTheThesissPrintedExample) {
  Image map(8, 8, 1);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) map.at(x, y) = static_cast<float>(kPrinted[7 - y][x]);
  const DepthPyramid pyramid(map);
  const MultiScaleLayers layers(context(), 8, WindowAnchor::Centre);
  layers.build(pyramid.minimum(), pyramid.maximum(), 0);
  ASSERT_EQ(layers.layers(), 3);
  for (int layer = 1; layer <= 3; ++layer) {
    const Image made = layers.texture().readLayer(layer - 1);
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x)
        EXPECT_EQ(made.at(x, y, 0), static_cast<float>(kPrinted[7 - y][8 * layer + x]))
            << "layer " << layer << " at " << x << ' ' << y;
  }
}

TEST_F(MultiScaleMapTest, EveryEntryHoldsTheRangeOfItsWindow) {
  std::mt19937 random(20260102);
  std::uniform_real_distribution<float> depth(0.1F, 50.0F);
  for (const WindowAnchor anchor : {WindowAnchor::Centre, WindowAnchor::Corner})
    for (const int resolution : {1, 2, 4, 16, 64}) {
      Image map(resolution, resolution, 1);
      for (float& z : map.data) z = random() % 5 == 0 ? kEmptyDepth : depth(random);
      const DepthPyramid pyramid(map);
      const MultiScaleLayers layers(context(), resolution, anchor);
      layers.build(pyramid.minimum(), pyramid.maximum(), 0);
      EXPECT_EQ(layers.texture().bytes(), int64_t{8} * resolution * resolution * layers.layers());
      for (int layer = 1; layer <= layers.layers(); ++layer) {
        const Image made = layers.texture().readLayer(layer - 1);
        const int size = 1 << layer;
        for (int y = 0; y < resolution; ++y)
          for (int x = 0; x < resolution; ++x) {
            const glm::ivec2 start = glm::ivec2(x, y) - (anchor == WindowAnchor::Centre ? size / 2 : 0);
            const glm::vec2 expected =
                rangeOf(map, glm::clamp(start, 0, resolution), glm::clamp(start + size, 0, resolution));
            ASSERT_EQ(glm::vec2(made.at(x, y, 0), made.at(x, y, 1)), expected)
                << resolution << " layer " << layer << " at " << x << ' ' << y;
          }
      }
    }
}

// Several dispatches of several layers, each in several groups: every border of the map, of a group's tile
// and of a dispatch's last layer is met, since the places are drawn at random near them and anywhere.
TEST_F(MultiScaleMapTest, EntriesOfLargeMapsHoldTheRangesOfTheirWindows) {
  std::mt19937 random(20261123);
  for (const WindowAnchor anchor : {WindowAnchor::Centre, WindowAnchor::Corner})
    for (const int resolution : {128, 256, 512}) {
      Image map(resolution, resolution, 1);
      // Steps of few texels: an entry that misses a row or column of its window has another range.
      for (float& z : map.data) z = random() % 37 == 0 ? kEmptyDepth : static_cast<float>(random() % 100000);
      const DepthPyramid pyramid(map);
      const MultiScaleLayers layers(context(), resolution, anchor);
      layers.build(pyramid.minimum(), pyramid.maximum(), 0);
      const auto place = [&] {
        const int anywhere = static_cast<int>(random() % static_cast<unsigned>(resolution));
        switch (random() % 4) {
          case 0:
            return static_cast<int>(random() % 20);
          case 1:
            return resolution - 1 - static_cast<int>(random() % 20);
          case 2:
            return anywhere / 16 * 16 + (random() % 2 == 0 ? 0 : 15);
          default:
            return anywhere;
        }
      };
      for (int layer = 1; layer <= layers.layers(); ++layer) {
        const Image made = layers.texture().readLayer(layer - 1);
        const int size = 1 << layer;
        for (int i = 0; i < 150; ++i) {
          const glm::ivec2 at(place(), place());
          const glm::ivec2 start = at - (anchor == WindowAnchor::Centre ? size / 2 : 0);
          const glm::vec2 expected =
              rangeOf(map, glm::clamp(start, 0, resolution), glm::clamp(start + size, 0, resolution));
          ASSERT_EQ(glm::vec2(made.at(at.x, at.y, 0), made.at(at.x, at.y, 1)), expected)
              << resolution << " layer " << layer << " at " << at.x << ' ' << at.y;
        }
      }
    }
}

TEST_F(MultiScaleMapTest, LayersOfAHybridHoldTheRangesOfItsBaseTexels) {
  // Over level 2 of a map of 32: windows of 2, 4, 8 base texels are windows of 8, 16, 32 texels of the map.
  std::mt19937 random(3);
  Image map(32, 32, 1);
  for (float& z : map.data) z = static_cast<float>(random() % 1000);
  const DepthPyramid pyramid(map);
  const MultiScaleLayers layers(context(), 8, WindowAnchor::Centre);
  layers.build(pyramid.minimum(), pyramid.maximum(), 2);
  for (int layer = 1; layer <= 3; ++layer) {
    const Image made = layers.texture().readLayer(layer - 1);
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) {
        const glm::ivec2 start = 4 * (glm::ivec2(x, y) - (1 << layer) / 2);
        const glm::vec2 expected =
            rangeOf(map, glm::clamp(start, 0, 32), glm::clamp(start + 4 * (1 << layer), 0, 32));
        ASSERT_EQ(glm::vec2(made.at(x, y, 0), made.at(x, y, 1)), expected) << "layer " << layer;
      }
  }
}

TEST_F(MultiScaleMapTest, EntriesOnThePyramidsGridAreThePyramid) {
  // What lets micro-occluders come from the pyramid whatever the structure: entry (k + 1/2) 2^i of layer i of
  // the multi-scale map, and entry k 2^i of the N-buffer, speak for texel k of the pyramid's level i.
  const scene::Scene scene = builtScene("sphere_grid");
  const GpuScene gpuScene(scene);
  Frame frame(context(), scene, gpuScene, {8, 8});
  frame.begin();
  const ShadowMapSettings map{64};
  const MinMaxPyramid& pyramid = frame.get<MinMaxPyramid>(map);
  for (const WindowAnchor anchor : {WindowAnchor::Centre, WindowAnchor::Corner}) {
    const MultiScaleMap& layers = frame.get<MultiScaleMap>(MultiScaleSettings{map, 64, anchor});
    for (int level = 1; level <= 6; ++level) {
      const Image made = layers.texture().readLayer(level - 1), minimum = pyramid.minimum().read(level),
                  maximum = pyramid.maximum().read(level - 1);
      const int first = anchor == WindowAnchor::Centre ? (1 << level) / 2 : 0;
      for (int y = 0; y < minimum.height; ++y)
        for (int x = 0; x < minimum.width; ++x) {
          const int u = first + (x << level), v = first + (y << level);
          ASSERT_EQ(made.at(u, v, 0), minimum.at(x, y)) << level;
          ASSERT_EQ(made.at(u, v, 1), maximum.at(x, y)) << level;
        }
    }
  }
  frame.end();
}

TEST_F(MultiScaleMapTest, MemoryIsThatOfTheThesissTable) {
  // Table 4.1 in MiB, without layer 0, which is the map itself: 88 - 8, 384 - 32, and 14.67 - 10.67 for a
  // base of 256.
  const scene::Scene scene = builtScene("two_boxes");
  const GpuScene gpuScene(scene);
  Frame frame(context(), scene, gpuScene, {8, 8});
  const auto heldBy = [&](const std::string& name) {
    for (const gl::PassList::Pass& pass : frame.passes().passes())
      if (pass.name == name) return static_cast<double>(pass.bytesHeld) / 1048576.0;
    return 0.0;
  };
  const MultiScaleMap full(frame, {{1024}, 1024, WindowAnchor::Centre});
  EXPECT_EQ(heldBy("frame/multi_scale_map"), 80.0);
  const MultiScaleMap hybrid(frame, {{2048}, 256, WindowAnchor::Centre});
  EXPECT_EQ(heldBy("frame/multi_scale_map"), 4.0);
  EXPECT_EQ(hybrid.baseLevel(), 3);
  const MultiScaleMap corner(frame, {{1024}, 1024, WindowAnchor::Corner});
  EXPECT_EQ(heldBy("frame/n_buffer"), 80.0);
}

TEST_F(MultiScaleMapTest, WhatDoesNotFitIsRefusedWithAWayOut) {
  // No device has textures of 65,536 texels a side, nor room for 512 GiB.
  try {
    const MultiScaleLayers layers(context(), 65536, WindowAnchor::Centre);
    ADD_FAILURE() << "not refused";
  } catch (const Error& error) {
    EXPECT_NE(error.message().find("65536 x 65536 x 16 texels (524288 MiB)"), std::string::npos)
        << error.what();
    EXPECT_NE(error.hint().find("ysm"), std::string::npos) << error.what();
  }
  context().takeDebugMessages();  // the driver's own words for it
}

}  // namespace
}  // namespace limen::frame
