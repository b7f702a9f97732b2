// SPDX-License-Identifier: BSD-3-Clause
// Biases that texels store: those of level 0 against planes in double precision, coarser ones against a twin
// that folds pairs as the thesis says.
#include "renderer/frame/bias_map.h"

#include <algorithm>
#include <array>
#include <random>

#include "renderer/frame/frame_bindings.h"
#include "tests/renderer/frame/brute_force.h"
#include "tests/renderer/frame/depth_pyramid.h"
#include "tests/renderer/gl/gl_fixture.h"

namespace limen::frame {
namespace {

/// A part of a surface at depth z that spans [z - h, z + b].
struct Patch {
  float z, b, h;
};

/// Schwarz 2009, section 4.5.4, for two neighbouring micropatches.
Patch together(Patch one, Patch other) {
  const Patch c = one.z <= other.z ? one : other, f = one.z <= other.z ? other : one;
  const float apart = std::abs(one.z - other.z);
  const bool overlap = f.z - f.h <= c.z + c.b && c.z - c.h <= f.z + f.b;
  return overlap ? Patch{c.z, std::max(apart + f.b, c.b), std::max(c.h, f.h - apart)} : c;
}

class BiasMapTest : public gl::GlTest {
 protected:
  /// Coarser levels of biases that belong to `map`, in two channels.
  static std::vector<Image> aggregated(const Image& map, const Image& biases) {
    const DepthPyramid pyramid(map);
    const BiasLevels levels(context(), map.width);
    levels.biases().write(biases);
    levels.aggregate(pyramid.minimum(), 0.0F);
    std::vector<Image> out;
    for (int level = 0; level < pyramid.levels(); ++level) out.push_back(levels.biases().read(level));
    return out;
  }

  static glm::vec2 ofFour(const std::array<Patch, 4>& patches) {
    Image map(2, 2, 1), biases(2, 2, 2);
    for (size_t i = 0; i < 4; ++i) {
      map.data[i] = patches[i].z;
      biases.data[2 * i] = patches[i].b;
      biases.data[2 * i + 1] = patches[i].h;
    }
    const Image top = aggregated(map, biases)[1];
    return {top.at(0, 0, 0), top.at(0, 0, 1)};
  }
};

TEST_F(BiasMapTest, TwoPatchesOfOneSurfaceBecomeOneThatSpansBoth) {
  const Patch none{kEmptyDepth, 0.0F, 0.0F};
  // [8, 12] and [11, 15] overlap: up to 15, that is 5 below 10; 13 - 2 lies below 8.
  EXPECT_EQ(ofFour({{{10, 2, 2}, {13, 2, 2}, none, none}}), glm::vec2(5, 2));
  // [8, 12] and [13, 17] do not: the far one is left to be shadowed.
  EXPECT_EQ(ofFour({{{10, 2, 2}, {15, 2, 2}, none, none}}), glm::vec2(2, 2));
  // The far one reaches above the near one, up to 7.5: the height grows too.
  EXPECT_EQ(ofFour({{{10.5F, 3, 3}, none, none, {10, 1, 1}}}), glm::vec2(3.5F, 2.5F));
  // The near one reaches below the far one.
  EXPECT_EQ(ofFour({{none, {10, 9, 1}, {12, 2, 1}, none}}), glm::vec2(9, 1));
  EXPECT_EQ(ofFour({{none, none, none, none}}), glm::vec2(0, 0));
}

TEST_F(BiasMapTest, FourPatchesAreFoldedNearestFirst) {
  // In steps of 1/4, which float adds and subtracts exactly, so that equality is asked for; many ties among
  // them.
  std::mt19937 engine(11);
  const auto quarter = [&](int low, int high) {
    return 0.25F * static_cast<float>(std::uniform_int_distribution<int>(low, high)(engine));
  };
  constexpr int kSide = 64;
  Image map(kSide, kSide, 1), biases(kSide, kSide, 2);
  for (size_t i = 0; i < map.pixels(); ++i) {
    map.data[i] = i % 17 == 0 ? kEmptyDepth : quarter(20, 60);
    for (size_t c = 0; c < 2; ++c) biases.data[2 * i + c] = i % 17 == 0 ? 0.0F : quarter(0, 12);
  }
  const std::vector<Image> levels = aggregated(map, biases);
  std::vector<Patch> below;
  for (size_t i = 0; i < map.pixels(); ++i)
    below.push_back({map.data[i], biases.data[2 * i], biases.data[2 * i + 1]});
  int overlapping = 0;
  for (int level = 1; level <= 6; ++level) {
    const int side = kSide >> level;
    std::vector<Patch> here;
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        std::vector<Patch> four;
        for (int i = 0; i < 4; ++i)
          four.push_back(below[static_cast<size_t>((2 * y + i / 2) * 2 * side + 2 * x + i % 2)]);
        std::stable_sort(four.begin(), four.end(), [](Patch a, Patch b) { return a.z < b.z; });
        const Patch folded = together(together(together(four[0], four[1]), four[2]), four[3]);
        here.push_back(folded);
        overlapping += folded.b != four[0].b;
        const Image& made = levels[static_cast<size_t>(level)];
        ASSERT_EQ(made.at(x, y, 0), folded.b) << "level " << level << " at " << x << ' ' << y;
        ASSERT_EQ(made.at(x, y, 1), folded.h) << "level " << level << " at " << x << ' ' << y;
      }
    below = here;
  }
  EXPECT_GT(overlapping, 100);
}

TEST_F(BiasMapTest, OnAPlaneATexelOfAnyLevelReachesItsDeepestCorner) {
  // A card that leans along both axes of the map. A texel of level i sees it wholly if all of level 0 in it
  // do; its nearest depth is that of a centre, its bias what is missing to its deepest corner.
  constexpr int kResolution = 64;
  for (const double offset : {0.0, 1000.0}) {
    scene::Scene scene = builtScene("parallel_rectangle", {{"offset", offset}});
    glm::dvec3 centre(0.0);
    int corners = 0;
    for (const scene::Part& part : scene.parts)
      if (!part.receiverOnly)
        for (uint32_t i = part.firstTriangle; i < part.firstTriangle + part.triangleCount; ++i)
          for (int corner = 0; corner < 3; ++corner, ++corners)
            centre += scene.mesh.positions[scene.mesh.triangles[i][corner]];
    centre /= std::max(corners, 1);
    std::vector<bool> moved(scene.mesh.positions.size(), false);
    for (const scene::Part& part : scene.parts)
      if (!part.receiverOnly)
        for (uint32_t i = part.firstTriangle; i < part.firstTriangle + part.triangleCount; ++i)
          for (int corner = 0; corner < 3; ++corner) {
            const uint32_t vertex = scene.mesh.triangles[i][corner];
            glm::dvec3& position = scene.mesh.positions[vertex];
            if (!moved[vertex]) position.y += 0.8 * (position.x - centre.x) + 0.5 * (position.z - centre.z);
            moved[vertex] = true;
          }
    const GpuScene gpuScene(scene);
    Frame frame(context(), scene, gpuScene, {8, 8});
    frame.begin();
    const ShadowMapSettings settings{kResolution};
    const BiasLevels& biases = frame.get<BiasMap>(BiasSettings{settings}).levels();
    const auto& triangles = frame.get<ShadowTriangles>(settings);
    const std::vector<uint32_t> ids = triangles.ids().readUint();
    const gl::Texture& minimum = frame.get<MinMaxPyramid>(settings).minimum();
    frame.end();
    const LightFrustum& frustum = triangles.frustum();
    const BruteForce truth(scene, gpuScene.anchor());
    const glm::dmat4 toLight = scene.lights[0].toLightSpace(gpuScene.anchor());
    const auto isCaster = [&](uint32_t id) {
      for (const scene::Part& part : scene.parts)
        if (!part.receiverOnly && id >= part.firstTriangle && id < part.firstTriangle + part.triangleCount)
          return true;
      return false;
    };
    int compared = 0;
    for (int level = 0; level <= 3; ++level) {
      const Image stored = biases.biases().read(level), depths = minimum.read(level);
      const int span = 1 << level;
      for (int y = 0; y < kResolution >> level; ++y)
        for (int x = 0; x < kResolution >> level; ++x) {
          bool whole = true;
          for (int v = 0; v < span; ++v)
            for (int u = 0; u < span; ++u)
              whole =
                  whole && isCaster(ids[static_cast<size_t>((y * span + v) * kResolution + x * span + u)]);
          if (!whole) continue;
          const uint32_t id = ids[static_cast<size_t>(y * span * kResolution + x * span)];
          const glm::dvec3 q = toLight * glm::dvec4(truth.corner(id, 0), 1.0);
          const glm::dvec3 n = glm::dmat3(toLight) * truth.normal(id);
          double deepest = 0.0;
          for (int corner = 0; corner < 4; ++corner) {
            const glm::dvec2 u =
                glm::dvec2(x + corner % 2, y + corner / 2) * double(span) / double(kResolution);
            const glm::dvec2 tangent = frustum.low + u * (frustum.high - frustum.low);
            deepest = std::max(deepest, glm::dot(n, q) / glm::dot(n, glm::dvec3(tangent, 1.0)));
          }
          ++compared;
          // Depths are rounded to float, and to the raster's own depth before that.
          EXPECT_NEAR(double(depths.at(x, y)) + stored.at(x, y, 0), deepest, 2e-5 * deepest)
              << "level " << level << " at " << x << ' ' << y;
        }
    }
    EXPECT_GT(compared, 500);
  }
}

}  // namespace
}  // namespace limen::frame
