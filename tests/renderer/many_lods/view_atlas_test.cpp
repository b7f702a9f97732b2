// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/many_lods/view_atlas.h"

#include <bit>
#include <glm/gtc/packing.hpp>

#include "renderer/many_lods/depth_packing.h"
#include "renderer/many_lods/gpu_tree.h"
#include "tests/renderer/many_lods/many_lods_fixture.h"

namespace limen::many_lods {
namespace {

TEST(DepthPacking, NearerWinsInBothWords) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  for (int i = 0; i < 100000; ++i) {
    const float near = unit(random), far = unit(random);
    // 2^-20 of the range apart at least: twice the step, in case of rounding.
    if (!(far - near > 0x1p-19F)) continue;
    const PackedSplat a = packSplat(near, random() & 0xffffffU), b = packSplat(far, random() & 0xffffffU);
    ASSERT_LT(a.low, b.low);
    ASSERT_LT(a.high, b.high);
  }
}

TEST(DepthPacking, ColoursAndDepthsComeBack) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  for (int i = 0; i < 100000; ++i) {
    const uint32_t colour = random() & 0xffffffU;
    const float depth = unit(random);
    const PackedSplat splat = packSplat(depth, colour);
    ASSERT_EQ(colourOf(splat), colour);
    // Cut off to 20 bits, after rounding to 23.
    ASSERT_NEAR(depthOf(splat.low), depth, 0x1p-20 + 0x1p-23);
  }
}

// 1 and 0.99999994, which the remap rounds to 1, have the exponent of the next octave: as printed they are
// nearer than everything else.
TEST(DepthPacking, TheFarPlaneIsFar) {
  for (const float far : {1.0F, 0.99999994F, 2.0F}) {
    EXPECT_GT(packSplat(far, 0).low, packSplat(0.5F, 0xffffffU).low);
    EXPECT_GT(packSplat(far, 0).high, packSplat(0.5F, 0xffffffU).high);
  }
  EXPECT_LT(packSplatAsPrinted(1.0F, 0).low, packSplatAsPrinted(0.0F, 1).low);
  EXPECT_LT(packSplatAsPrinted(0.99999994F, 0).low, packSplatAsPrinted(0.0F, 1).low);
  // Nothing is farther than the clear value, and white at the far end is the same as it.
  EXPECT_EQ(packSplat(1.0F, 0xffffffU).low, PackedSplat{}.low);
  EXPECT_LT(packSplat(1.0F, 0).low, PackedSplat{}.low);
}

// Fragments of one depth, of which each word keeps the lesser bits.
TEST(DepthPacking, TiesMixColours) {
  const PackedSplat a = packSplat(0.25F, 0x001fffU), b = packSplat(0.25F, 0x002000U);
  const PackedSplat both{std::min(a.low, b.low), std::min(a.high, b.high)};
  EXPECT_EQ(colourOf(both), 0x001000U);
}

class ViewAtlases : public gl::GlTest {
 protected:
  static constexpr int kDepth = 13;
  static constexpr int kSide = 32;
  static const Triangles& surface() {
    static const Triangles kSurface = bumpyBalls();
    return kSurface;
  }
  static const SphereTree& tree(double leafScale = 2.0) {
    static const SphereTree kTree = treeOf(surface(), kDepth, leafScale);
    return kTree;
  }

  struct Disc {
    glm::dvec2 centre;
    double radius, depth;
  };
  /// In double precision, through the definition: the circle through the projections of the directions at
  /// both ends of the cone around the sphere. False: behind.
  static bool discOf(glm::dvec4 sphere, const CutView& view, Disc& out) {
    const glm::dvec3 v = glm::dvec3(sphere) - glm::dvec3(glm::vec3(view.eye));
    const auto along = [&](glm::vec4 axis) { return glm::dot(v, glm::dvec3(glm::vec3(axis))); };
    const double distance = glm::length(v);
    if (distance <= sphere.w) return false;
    if (view.axisZ.w == float(kViewPerspective)) {
      const double z = along(view.axisZ);
      if (z <= 0.0) return false;
      const double scale = kSide / (2.0 * z);
      out = {{0.5 * kSide + along(view.axisX) * scale / double(view.axisX.w),
              0.5 * kSide + along(view.axisY) * scale / double(view.axisY.w)},
             sphere.w * scale / double(view.axisY.w),
             z * double(view.frustum.z)};
      return true;
    }
    if (along(view.axisZ) < -sphere.w) return false;  // wholly behind the horizon
    const double theta = std::acos(std::clamp(along(view.axisZ) / distance, -1.0, 1.0));
    const double alpha = std::asin(sphere.w / distance);
    if (theta + alpha > 2.9) return false;
    const glm::dvec2 across(along(view.axisX), along(view.axisY));
    const glm::dvec2 way = glm::length(across) > 0.0 ? across / glm::length(across) : glm::dvec2(1.0, 0.0);
    const auto project = [&](double angle) {
      return (glm::dvec2(0.5) + 0.5 * way * std::sin(angle) / (1.0 + std::cos(angle))) * double(kSide);
    };
    const glm::dvec2 from = project(theta - alpha), to = project(theta + alpha);
    out = {0.5 * (from + to), 0.5 * glm::distance(from, to), distance * double(view.frustum.z)};
    return true;
  }
};

// Every pixel against all nodes of the cut, one by one: its depth is no less than the least of those whose
// discs reach it with a hundredth of a pixel added, and no more than that of those that do with as much taken
// off.
TEST_F(ViewAtlases, HoldTheNearestNodeOfEveryPixel) {
  const GpuTree onGpu(context(), tree());
  std::mt19937 random(11);
  std::vector<CutView> views;
  for (int i = 0; i < 24; ++i) {
    const glm::dvec3 eye(anyDirection(random) * 12.0);
    if (i % 2 == 0)
      views.push_back(hemisphereView(eye, anyDirection(random), kSide, 1.0, 60.0));
    else
      views.push_back(perspectiveView(eye, -eye, anyDirection(random), {0.8, 0.8}, kSide, 1.0, 60.0));
  }
  const gl::Buffer onGpuViews(views);
  MultiCut cut(context(), uint32_t(views.size()), kDepth, 1U << 18, BasicCuts{});
  cut.update(onGpu.nodes(), onGpuViews);
  const std::vector<glm::uvec2> list = cut.list();
  const ViewAtlas atlas(context(), uint32_t(views.size()), glm::ivec2(kSide), AtlasForm::TwoPasses);
  atlas.draw(cut, onGpu.nodes(), onGpuViews, {});
  const std::vector<uint32_t> depths = atlas.depths().read<uint32_t>(),
                              winners = atlas.winners().read<uint32_t>();
  constexpr double kPxSlack = 0.01, kDepthSlack = 1e-5;
  const size_t pixels = size_t(kSide) * kSide * views.size();
  std::vector<double> least(pixels, 2.0), most(pixels, 2.0);
  // What has no circle may be drawn anywhere.
  std::vector<double> any(views.size(), 2.0);
  for (const glm::uvec2 entry : list) {
    Disc disc;
    const glm::dvec4 sphere = tree().spheres[entry.x];
    if (!discOf(sphere, views[entry.y], disc)) {
      if (views[entry.y].axisZ.w == float(kViewPerspective)) continue;
      const double farthest = glm::distance(glm::dvec3(sphere), glm::dvec3(glm::vec3(views[entry.y].eye)));
      any[entry.y] = std::min(any[entry.y], farthest / 60.0);
      continue;
    }
    const auto low = glm::max(glm::ivec2(glm::floor(disc.centre - disc.radius - 1.0)), glm::ivec2(0));
    const auto high = glm::min(glm::ivec2(glm::ceil(disc.centre + disc.radius + 1.0)), glm::ivec2(kSide - 1));
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x) {
        const size_t at = (size_t(entry.y) * kSide + size_t(y)) * kSide + size_t(x);
        const double away = glm::distance(glm::dvec2(x + 0.5, y + 0.5), disc.centre);
        const glm::dvec2 within = glm::abs(glm::dvec2(x + 0.5, y + 0.5) - disc.centre);
        const double square = std::max(within.x, within.y);
        if (away < disc.radius + kPxSlack || square < 0.5 + kPxSlack)
          least[at] = std::min(least[at], disc.depth);
        if (away < disc.radius - kPxSlack || square < 0.5 - kPxSlack)
          most[at] = std::min(most[at], disc.depth);
      }
  }
  int covered = 0, compared = 0;
  for (size_t at = 0; at < pixels; ++at) {
    const double depth = depths[at] == kAtlasEmpty ? 2.0 : std::bit_cast<float>(depths[at]);
    const size_t view = at / (size_t(kSide) * kSide);
    ASSERT_GE(depth, std::min(least[at], any[view]) - kDepthSlack) << "pixel " << at;
    ASSERT_LE(depth, most[at] + kDepthSlack) << "pixel " << at;
    ASSERT_EQ(winners[at] == kAtlasEmpty, depths[at] == kAtlasEmpty);
    if (depths[at] == kAtlasEmpty) continue;
    ++covered;
    Disc disc;
    if (!discOf(tree().spheres[winners[at]], views[view], disc)) continue;
    ++compared;
    ASSERT_NEAR(disc.depth, depth, kDepthSlack);
  }
  EXPECT_GT(covered, 5000);
  EXPECT_GT(compared, 0.9 * covered);
}

// The other views look away from all there is.
TEST_F(ViewAtlases, NoPixelOfAnotherTileIsWritten) {
  const GpuTree onGpu(context(), tree());
  const CutView away = hemisphereView({0, 0, 1e5}, {0, 0, 1}, kSide, 1.0, 60.0);
  std::mt19937 random(12);
  for (int i = 0; i < 40; ++i) {
    CutView middle = anyView(random, tree(), 4.0);
    const std::vector<CutView> views = {away, middle, away};
    const gl::Buffer onGpuViews(views);
    MultiCut cut(context(), 3, kDepth, 1U << 16, BasicCuts{});
    cut.update(onGpu.nodes(), onGpuViews);
    for (const AtlasForm form : {AtlasForm::Depth, AtlasForm::TwoPasses}) {
      const ViewAtlas atlas(context(), 3, glm::ivec2(kSide), form);
      // Discs of any size.
      atlas.draw(cut, onGpu.nodes(), onGpuViews, {.radiusScale = i % 4 == 0 ? 30.0F : 1.0F});
      const std::vector<uint32_t> depths = atlas.depths().read<uint32_t>();
      constexpr size_t kTile = size_t(kSide) * kSide;
      for (size_t at = 0; at < 3 * kTile; ++at)
        if (at < kTile || at >= 2 * kTile) {
          ASSERT_EQ(depths[at], kAtlasEmpty) << "view " << i << ", " << at;
        }
    }
  }
}

/// Distance to the first triangle, or infinity; one by one.
double firstHit(const Triangles& of, glm::dvec3 origin, glm::dvec3 direction) {
  double first = INFINITY;
  for (const glm::uvec3 t : of.triangles) {
    const glm::dvec3 a = of.positions[t.x], e1 = of.positions[t.y] - a, e2 = of.positions[t.z] - a;
    const glm::dvec3 p = glm::cross(direction, e2);
    const double determinant = glm::dot(e1, p);
    if (std::abs(determinant) < 1e-14) continue;
    const glm::dvec3 s = origin - a, q = glm::cross(s, e1);
    const double u = glm::dot(s, p) / determinant, v = glm::dot(direction, q) / determinant;
    const double along = glm::dot(e2, q) / determinant;
    if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && along > 1e-9) first = std::min(first, along);
  }
  return first;
}

// Against the triangles themselves, met by rays through the middles of pixels: which share of the pixels that
// show a surface is empty, and how far the depths of the others are off where the surface goes on around
// them.
TEST_F(ViewAtlases, HolesAndDepthsAgainstTriangles) {
  const GpuTree onGpu(context(), tree());
  std::mt19937 random(13);
  std::vector<CutView> views;
  for (int i = 0; i < 6; ++i) {
    const glm::dvec3 eye(8.0 * std::cos(i), 4.0 + i, 8.0 * std::sin(i));
    views.push_back(hemisphereView(eye, glm::dvec3(0.0, 1.0, 0.0) - eye, kSide, 1.0, 60.0));
  }
  const gl::Buffer onGpuViews(views);
  MultiCut cut(context(), uint32_t(views.size()), kDepth, 1U << 18, BasicCuts{});
  cut.update(onGpu.nodes(), onGpuViews);
  const ViewAtlas atlas(context(), uint32_t(views.size()), glm::ivec2(kSide), AtlasForm::Depth);
  atlas.draw(cut, onGpu.nodes(), onGpuViews, {});
  const std::vector<uint32_t> depths = atlas.depths().read<uint32_t>();
  int shown = 0, holes = 0, wrong = 0;
  for (size_t view = 0; view < views.size(); ++view)
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const glm::dvec2 p = 2.0 * glm::dvec2(x + 0.5, y + 0.5) / double(kSide) - 1.0;
        if (glm::length(p) > 0.98) continue;
        const double square = glm::dot(p, p);
        const glm::dvec3 direction = (2.0 * p.x * glm::dvec3(glm::vec3(views[view].axisX)) +
                                      2.0 * p.y * glm::dvec3(glm::vec3(views[view].axisY)) +
                                      (1.0 - square) * glm::dvec3(glm::vec3(views[view].axisZ))) /
                                     (1.0 + square);
        const double right = firstHit(surface(), glm::dvec3(glm::vec3(views[view].eye)), direction);
        if (!std::isfinite(right)) continue;
        ++shown;
        const uint32_t found = depths[(view * kSide + size_t(y)) * kSide + size_t(x)];
        if (found == kAtlasEmpty) {
          ++holes;
        } else if (std::abs(double(std::bit_cast<float>(found)) * 60.0 - right) > 0.15 * right) {
          ++wrong;
        }
      }
  ASSERT_GT(shown, 2000);
  // Discs of twice the radius that would cover the surface once leave exp(-4), 1.8 %, of points at random
  // uncovered, and fewer of even ones. Inner nodes are spheres around their points, larger than that.
  EXPECT_LT(holes, 0.018 * shown);
  // Off by more than 15 %: beside silhouettes, by a pixel around them. The three balls' outlines are at most
  // 15 % of the pixels.
  EXPECT_LT(wrong, 0.15 * shown);
}

TEST_F(ViewAtlases, TwoWordsHoldTheColourOfTheNearest) {
  const GpuTree onGpu(context(), tree());
  const std::vector<CutView> views = {hemisphereView({0, 9, 0}, {0, -1, 0}, kSide, 2.0, 60.0)};
  const gl::Buffer onGpuViews(views);
  MultiCut cut(context(), 1, kDepth, 1U << 16, BasicCuts{});
  cut.update(onGpu.nodes(), onGpuViews);
  // A colour for each node, by its number: bytes as halves that are exact to a hundredth of a step.
  std::vector<glm::uvec2> colours;
  for (uint32_t node = 0; node < 2U << kDepth; ++node)
    colours.emplace_back(glm::packHalf2x16(glm::vec2(node & 255U, node >> 8) / 255.0F),
                         glm::packHalf2x16(glm::vec2(0.5F, 1.0F)));
  const gl::Buffer onGpuColours(colours);
  const ViewAtlas words(context(), 1, glm::ivec2(kSide), AtlasForm::TwoWords);
  words.draw(cut, onGpu.nodes(), onGpuViews, {}, &onGpuColours);
  const ViewAtlas passes(context(), 1, glm::ivec2(kSide), AtlasForm::TwoPasses);
  passes.draw(cut, onGpu.nodes(), onGpuViews, {});
  const std::vector<uint32_t> low = words.depths().read<uint32_t>(), high = words.winners().read<uint32_t>();
  const std::vector<uint32_t> depth = passes.depths().read<uint32_t>(),
                              node = passes.winners().read<uint32_t>();
  int same = 0, shown = 0;
  for (size_t i = 0; i < depth.size(); ++i) {
    ASSERT_EQ(low[i] == kAtlasEmpty, depth[i] == kAtlasEmpty);
    if (depth[i] == kAtlasEmpty) continue;
    ++shown;
    ASSERT_NEAR(depthOf(low[i]), std::bit_cast<float>(depth[i]), 0x1p-20 + 0x1p-23);
    same += (colourOf({low[i], high[i]}) & 0xffffU) == node[i] ? 1 : 0;
  }
  ASSERT_GT(shown, 300);
  // Others tie in their 20 bits. With nodes a hundredth of the range apart and a few to a pixel that is rare.
  EXPECT_GE(same, 0.99 * shown);
}

}  // namespace
}  // namespace limen::many_lods
