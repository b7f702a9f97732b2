// SPDX-License-Identifier: BSD-3-Clause
// Levels of quality: what the passes hand to one another, worked out again in double precision, and what must
// not change whichever way the work is split.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "experiments/base/error.h"
#include "renderer/techniques/soft_shadows/pixel_counts.h"
#include "renderer/techniques/soft_shadows/search_settings.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

constexpr const char* kArea = "soft_shadows/backprojection";

/// A render with what its passes made of each pixel.
struct Graded {
  Image visibility, receivers, depth;
  Image levels;                 // of the split form: first channel
  std::vector<uint32_t> areas;  // of the split form
  PixelCounts counted;
  std::map<std::string, double> counters;
  std::vector<std::string> passes;
  std::vector<Image> pyramid;
  frame::LightFrustum frustum;

  PixelClass kind(size_t pixel) const { return static_cast<PixelClass>(counted.work[4 * pixel]); }
  float level(size_t pixel) const { return std::bit_cast<float>(counted.search[4 * pixel + 3]); }
};

class LevelsOfQuality : public TechniqueTest {
 protected:
  static Graded grade(const scene::Scene& scene, const std::string& technique, const Given& given,
                      glm::ivec2 sizePx) {
    const TechniqueInfo& info = TechniqueRegistry::instance().get(technique);
    const ParameterValues values(info.parameters, given);
    if (info.check) info.check(values);
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, sizePx);
    const auto made = info.make(values);
    made->prepare(frame);
    // Twice: what one frame leaves behind is no concern of the next.
    for (int i = 0; i < 2; ++i) {
      frame.begin();
      made->render(frame);
      if (i == 0) frame.end();
    }
    Graded out;
    out.visibility = made->product().read();
    const auto views = made->debugViews();
    if (views.count("levels")) {
      out.levels = views.at("levels")->read();
      out.areas = views.at("search_areas")->readUint();
    }
    out.receivers = frame.get<frame::Receivers>().texture().read();
    for (const gl::PassList::Pass& pass : frame.passes().passes())
      if (pass.ran) out.passes.push_back(pass.name);
    out.depth =
        frame.get<frame::GBufferChannel>(frame::ChannelSetting{frame::Channel::Depth}).texture().read();
    const auto& pyramid = frame.get<frame::MinMaxPyramid>(
        frame::ShadowMapSettings{SearchSettings::table().read(values).map.resolution});
    for (int level = 0; level < pyramid.levels(); ++level)
      out.pyramid.push_back(pyramid.minimum().read(level));
    out.frustum = pyramid.frustum();
    frame.end();
    for (const Counter& counter : made->count(frame)) out.counters[counter.name] = counter.value;
    out.counted = dynamic_cast<const CountsPixels&>(*made).counted();
    return out;
  }

  static Given with(Given given, const Given& more) {
    for (const auto& [name, value] : more) given[name] = value;
    return given;
  }

  static ParameterValue text(const char* value) { return std::string(value); }

  static Given unsmoothed() {
    return {{"passes", text("split")}, {"passes.smoothing", text("none")}, {"passes.lanes", int64_t{1}}};
  }

  /// Some pixels of all classes, several levels among the processed ones.
  static Given common() {
    return inThesisForm(
        {{"resolution", int64_t{256}}, {"budget.limit", int64_t{36}}, {"structure", text("mssm")}});
  }
};

bool sameBits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST_F(LevelsOfQuality, SplitPassesGiveTheBitsOfTheSingleOne) {
  struct Tried {
    const char* technique;
    Given given;
    glm::ivec2 sizePx;
  };
  const Given blended = {{"levels", text("blend")}};
  const std::vector<Tried> all = {
      {kArea, {}, {64, 48}},
      {kArea, blended, {61, 45}},
      {kArea,
       with(blended, {{"levels", text("dither")}, {"levels.source", text("filtered_depth")}}),
       {64, 48}},
      {kArea, {{"structure", text("hsm")}, {"occluders", text("microquads")}}, {64, 48}},
      {kArea,
       {{"budget", text("radial")}, {"budget.centre", int64_t{36}}, {"budget.rim", int64_t{4}}},
       {64, 48}},
      {"soft_shadows/bitmask", blended, {64, 48}},
      {kArea, {}, {13, 7}},
      {kArea, {}, {1, 1}}};
  const scene::Scene scene = makeScene("sphere_grid");
  for (const Tried& tried : all) {
    SCOPED_TRACE(testing::Message() << tried.technique << ' ' << tried.sizePx.x);
    Given given = with(common(), tried.given);
    if (given.count("budget")) given.erase("budget.limit");
    const Graded single =
        grade(scene, tried.technique, with(given, {{"passes", text("single")}}), tried.sizePx);
    const Graded split = grade(scene, tried.technique, with(given, unsmoothed()), tried.sizePx);
    EXPECT_TRUE(sameBits(single.visibility.data, split.visibility.data));
    EXPECT_EQ(single.counted.work, split.counted.work);
    EXPECT_EQ(single.counted.search, split.counted.search);
    if (tried.given.empty()) {
      const Graded ordered = grade(scene, tried.technique,
                                   with(given, {{"passes", text("split")},
                                                {"passes.lanes", int64_t{1}},
                                                {"passes.order", text("loop_length")}}),
                                   tried.sizePx);
      EXPECT_TRUE(sameBits(single.visibility.data, ordered.visibility.data));
      EXPECT_EQ(single.counted.work, ordered.counted.work);
    }
    if (tried.sizePx.x < 16) continue;
    std::array<int, ClassCount> pixels{};
    for (size_t i = 0; i < single.visibility.pixels(); ++i) ++pixels.at(single.kind(i));
    EXPECT_GT(pixels[Lit], 100);
    EXPECT_GT(pixels[Umbra], 10);
    EXPECT_GT(pixels[Processed], 100);
  }
}

TEST_F(LevelsOfQuality, EachPassHasItsName) {
  const scene::Scene scene = makeScene("two_boxes");
  const auto ran = [&](const Graded& graded, const std::string& name) {
    return std::count(graded.passes.begin(), graded.passes.end(), std::string(kArea) + name);
  };
  const Given split = {{"passes", text("split")}, {"resolution", int64_t{64}}};
  const Graded hard = grade(scene, kArea, split, {16, 16});
  EXPECT_EQ(ran(hard, "/classify"), 1);
  EXPECT_EQ(ran(hard, "/smooth"), 0);
  EXPECT_EQ(ran(hard, "/gather"), 1);
  EXPECT_EQ(ran(hard, ""), 0);
  EXPECT_EQ(ran(grade(scene, kArea, with(split, {{"levels", text("blend")}}), {16, 16}), "/smooth"), 1);
  // All levels are 0 without a limit: nothing to smooth.
  const Graded unlimited =
      grade(scene, kArea, with(split, {{"levels", text("blend")}, {"budget.limit", int64_t{0}}}), {16, 16});
  EXPECT_EQ(ran(unlimited, "/smooth"), 0);
}

/// One level of micropatches without filled gaps, summed in double precision. False: a texel is so near to
/// the depth that decides that float may see it on the other side.
bool occludedArea(const Graded& graded, glm::dvec2 lightSize, size_t pixel, int level, double bias,
                  double& area) {
  const glm::dvec3 p(graded.receivers.data[4 * pixel], graded.receivers.data[4 * pixel + 1],
                     graded.receivers.data[4 * pixel + 2]);
  const Image& map = graded.pyramid[static_cast<size_t>(level)];
  const glm::dvec2 texel = (graded.frustum.high - graded.frustum.low) / double(map.width);
  const uint32_t* bounds = &graded.areas[4 * pixel];
  area = 0.0;
  for (uint32_t y = bounds[1] >> level; y <= (bounds[3] - 1) >> level; ++y)
    for (uint32_t x = bounds[0] >> level; x <= (bounds[2] - 1) >> level; ++x) {
      const double z = map.at(static_cast<int>(x), static_cast<int>(y)), depth = p.z * (1.0 - bias);
      if (std::abs(z - depth) < 1e-6 * depth) return false;
      if (z >= depth) continue;
      glm::dvec2 edges[2];
      for (const uint32_t end : {0U, 1U}) {
        const glm::dvec2 tangent = graded.frustum.low + glm::dvec2(x + end, y + end) * texel;
        // Where the line from p through the texel's edge, at depth z, meets the plane of the light.
        const glm::dvec2 q = tangent * z;
        const glm::dvec2 s = q + (q - glm::dvec2(p)) * (z / (p.z - z));
        edges[end] = glm::clamp(s / lightSize + 0.5, 0.0, 1.0);
      }
      area += (edges[1].x - edges[0].x) * (edges[1].y - edges[0].y);
    }
  area = std::min(area, 1.0);
  return true;
}

// Float: unit light coordinates err by some 1e-7 times the throw z / (p_z - z), here up to 100, for each of
// up to 2 * 49 rectangles of the budget and 4 * 49 of twice the count per axis, whose other extent is at most
// 1: below 1e-3 even if all errors add up.
TEST_F(LevelsOfQuality, BlendsWhatBothLevelsGiveOnTheirOwn) {
  const scene::Scene scene = makeScene("sphere_grid");
  const double bias = 0.002;
  const Given given = with(common(), {{"passes", text("split")},
                                      {"occluders.gap_fill", text("none")},
                                      {"bias.constant", bias},
                                      {"bias.slope", 0.0}});
  struct Tried {
    const char* levels;
    double width;  // of the zone in which levels are blended
  };
  for (const Tried& tried : {Tried{"blend", 1.0}, Tried{"narrow_blend", 0.5}}) {
    Given chosen = with(given, {{"levels", text(tried.levels)}});
    if (tried.width < 1.0) chosen["levels.width"] = tried.width;
    const Graded graded = grade(scene, kArea, chosen, {64, 48});
    int blended = 0, single = 0;
    for (size_t i = 0; i < graded.visibility.pixels(); ++i) {
      if (graded.kind(i) != Processed) continue;
      const double level = graded.levels.data[2 * i];
      const int finer = static_cast<int>(std::floor(level));
      const double weight = std::clamp((level - finer - 0.5 * (1.0 - tried.width)) / tried.width, 0.0, 1.0);
      double fine = 0.0, coarse = 0.0;
      if (!occludedArea(graded, scene.lights[0].size, i, finer, bias, fine)) continue;
      if (weight > 0.0 && !occludedArea(graded, scene.lights[0].size, i, finer + 1, bias, coarse)) continue;
      const double expected = 1.0 - ((1.0 - weight) * fine + weight * coarse);
      ASSERT_NEAR(graded.visibility.data[i], expected, 1e-3) << tried.levels << " pixel " << i;
      ++(weight > 0.0 && weight < 1.0 ? blended : single);
    }
    EXPECT_GT(blended, tried.width < 1.0 ? 10 : 100) << tried.levels;
    EXPECT_GT(single, 20) << tried.levels;
  }
}

/// The filter along one axis over one line of pixels, from its definition: the mean, by Gaussian weights, of
/// the stretch of processed pixels around each that no step of depth interrupts.
std::vector<double> smoothedLine(const std::vector<double>& levels, const std::vector<double>& depths,
                                 int radius, double sigma, double threshold) {
  const auto reached = [&](size_t from, size_t to) {
    for (size_t i = std::min(from, to); i <= std::max(from, to); ++i) {
      if (levels[i] < 0.0) return false;
      if (i > std::min(from, to) &&
          std::abs(depths[i] - depths[i - 1]) > threshold * std::min(depths[i], depths[i - 1]))
        return false;
    }
    return true;
  };
  std::vector<double> out = levels;
  for (size_t i = 0; i < levels.size(); ++i) {
    if (levels[i] < 0.0) continue;
    double sum = 0.0, weights = 0.0;
    for (size_t j = 0; j < levels.size(); ++j) {
      const double away = double(j) - double(i);
      if (std::abs(away) > radius || !reached(i, j)) continue;
      const double weight = std::exp(-0.5 * away * away / (sigma * sigma));
      sum += weight * levels[j];
      weights += weight;
    }
    out[i] = sum / weights;
  }
  return out;
}

std::vector<double> smoothed(const Graded& graded, const std::vector<double>& levels, int radius,
                             double sigma, double threshold) {
  const int width = graded.depth.width, height = graded.depth.height;
  std::vector<double> out = levels;
  const auto filter = [&](int lines, int count, int lineStep, int step) {
    for (int line = 0; line < lines; ++line) {
      std::vector<double> of, depths;
      for (int i = 0; i < count; ++i) {
        const auto at = static_cast<size_t>(line * lineStep + i * step);
        of.push_back(out[at]);
        depths.push_back(graded.depth.data[at]);
      }
      of = smoothedLine(of, depths, radius, sigma, threshold);
      for (int i = 0; i < count; ++i)
        out[static_cast<size_t>(line * lineStep + i * step)] = of[static_cast<size_t>(i)];
    }
  };
  filter(height, width, width, 1);
  filter(width, height, 1, width);
  return out;
}

// The levels that go in are those of a render without a filter. Means of float levels up to 8 err by some
// 1e-6; a step of depth within float's reach of the threshold may fall either way, so the threshold is one
// that no pair is near to.
TEST_F(LevelsOfQuality, SmoothsAsTheFilterIsDefined) {
  const scene::Scene scene = makeScene("sphere_grid");
  const Given given = with(common(), {{"passes", text("split")}, {"levels", text("blend")}});
  for (const glm::ivec2 size : {glm::ivec2(64, 48), glm::ivec2(13, 7)}) {
    const Graded before = grade(scene, kArea, with(given, unsmoothed()), size);
    std::vector<double> levels;
    for (size_t i = 0; i < before.visibility.pixels(); ++i)
      levels.push_back(before.kind(i) == Processed ? double{before.level(i)} : -1.0);
    for (const int radius : {1, 10}) {
      const double sigma = 0.6 * radius, threshold = 0.0203;
      const Graded after = grade(scene, kArea,
                                 with(given, {{"passes.smoothing.radius", int64_t{radius}},
                                              {"passes.smoothing.sigma", sigma},
                                              {"passes.smoothing.depth_threshold", threshold}}),
                                 size);
      const std::vector<double> expected = smoothed(before, levels, radius, sigma, threshold);
      double most = 0.0;
      for (size_t i = 0; i < expected.size(); ++i) {
        ASSERT_NEAR(after.levels.data[2 * i], expected[i], 2e-5) << radius << " pixel " << i;
        most = std::max(most, std::abs(expected[i] - levels[i]));
      }
      if (size.x > 16) {
        EXPECT_GT(most, 0.1) << radius;
      }
    }
  }
}

// A search area of e texels on an axis has at most e / 2^i + 2 micro-occluders of level i there, less what
// level 0 shows to be none: cells of c texels, of which e in a row touch at most (e - 2) / c + 2. With r the
// budget's root and a level l that is not smoothed, e <= r 2^l; cells of the level above have at least 2^l
// texels, those of the level below more than half of that: r + 2 and 2 r + 2 on an axis. The thesis says
// roughly b and 4 b.
TEST_F(LevelsOfQuality, KeepsToFiveBudgetsOfOccluders) {
  const scene::Scene scene = makeScene("sphere_grid");
  for (const int64_t root : {3, 5, 12}) {
    const Given given = with(common(), {{"budget.limit", root * root}, {"levels", text("blend")}});
    const Graded graded = grade(scene, kArea, given, {64, 48});
    const auto bound = static_cast<uint32_t>((root + 2) * (root + 2) + (2 * root + 2) * (2 * root + 2));
    uint32_t most = 0;
    for (size_t i = 0; i < graded.visibility.pixels(); ++i) {
      if (graded.kind(i) != Processed) continue;
      most = std::max(most, graded.counted.search[4 * i + 1]);
      // A whole level keeps to the budget but for the grid.
      if (graded.level(i) > 0.0F && graded.level(i) == std::floor(graded.level(i))) {
        EXPECT_LE(graded.counted.search[4 * i + 1], static_cast<uint32_t>((root + 2) * (root + 2)));
      }
    }
    EXPECT_LE(most, bound) << root;
    EXPECT_GT(most, static_cast<uint32_t>(root * root)) << root;
    EXPECT_GT(graded.counters.at("examined_per_budget"), 0.5) << root;
    EXPECT_LT(graded.counters.at("examined_per_budget"),
              5.0 + 12.0 / double(root) + 8.0 / double(root * root));
    EXPECT_NEAR(graded.counters.at("examined_per_budget") * double(root * root),
                graded.counters.at("examined_per_px"), 1e-6 * graded.counters.at("examined_per_px"));
  }
}

// Of the levels at hand, finest_within keeps to the budget and coarsest_over is the floor of the real level.
TEST_F(LevelsOfQuality, HardChoicesEncloseTheRealLevel) {
  const scene::Scene scene = makeScene("sphere_grid");
  const auto render = [&](const Given& more) { return grade(scene, kArea, with(common(), more), {64, 48}); };
  // Without growth, search areas do not depend on levels.
  const Given fixed = {{"structure.growth", false}};
  const Graded within = render(with(fixed, {{"levels", text("finest_within")}}));
  const Graded over = render(with(fixed, {{"levels", text("coarsest_over")}}));
  const Graded real = render(with(fixed, {{"levels", text("blend")}}));
  int between = 0;
  for (size_t i = 0; i < real.visibility.pixels(); ++i) {
    ASSERT_EQ(real.kind(i), within.kind(i));
    if (real.kind(i) != Processed) continue;
    ASSERT_EQ(over.level(i), std::floor(real.level(i)));
    ASSERT_GE(within.level(i), std::ceil(real.level(i)));
    // Aligning the area to the grid may cost one more level.
    ASSERT_LE(within.level(i), std::ceil(real.level(i)) + 1.0F);
    // 6 micro-occluders an axis.
    const double extent = std::exp2(double{real.level(i)}) * 6.0;
    if (real.level(i) > 0.0F) {
      ASSERT_NEAR(extent, std::round(extent), 1e-3) << i;
    }
    between += real.level(i) != std::floor(real.level(i));
  }
  EXPECT_GT(between, 100);
}

TEST_F(LevelsOfQuality, BudgetMapsGiveEachPixelWhatItsBudgetGives) {
  const scene::Scene scene = makeScene("sphere_grid");
  const glm::ivec2 size(64, 48);
  for (const char* levels : {"finest_within", "blend"}) {
    Given given = with(with(common(), unsmoothed()), {{"levels", text(levels)}});
    given.erase("budget.limit");
    const auto render = [&](const Given& more) { return grade(scene, kArea, with(given, more), size); };
    const Graded centre = render({{"budget.limit", int64_t{49}}}),
                 rim = render({{"budget.limit", int64_t{9}}});
    const Graded same =
        render({{"budget", text("radial")}, {"budget.centre", int64_t{49}}, {"budget.rim", int64_t{49}}});
    EXPECT_TRUE(sameBits(same.visibility.data, centre.visibility.data)) << levels;
    const double inner = 0.3, outer = 0.5;
    const Graded map = render({{"budget", text("radial")},
                               {"budget.centre", int64_t{49}},
                               {"budget.rim", int64_t{9}},
                               {"budget.inner", inner},
                               {"budget.outer", outer}});
    int inside = 0, outside = 0;
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) {
        const auto i = static_cast<size_t>(y * size.x + x);
        const double away = glm::length(glm::dvec2(x + 0.5 - 32.0, y + 0.5 - 24.0)) / 32.0;
        if (away < inner - 1e-6) {
          ASSERT_EQ(map.visibility.data[i], centre.visibility.data[i]) << levels << ' ' << i;
          inside += map.kind(i) == Processed;
        } else if (away > outer + 1e-6) {
          ASSERT_EQ(map.visibility.data[i], rim.visibility.data[i]) << levels << ' ' << i;
          outside += map.kind(i) == Processed;
        }
      }
    EXPECT_GT(inside, 20);
    EXPECT_GT(outside, 20);
  }
}

// A smaller budget makes areas grow to coarser texels before their depth range is asked for, and a wider
// range leaves more pixels between lit and umbra (Schwarz 2009, table 5.1).
TEST_F(LevelsOfQuality, SmallerBudgetsProcessMorePixels) {
  const scene::Scene scene = makeScene("sphere_grid");
  double last = 1.0;
  for (const int64_t budget : {25, 144, 0}) {
    const Given given =
        with(common(), {{"budget.limit", budget}, {"passes", text("split")}, {"levels", text("blend")}});
    const double share = grade(scene, kArea, given, {96, 72}).counters.at("processed_share");
    EXPECT_LT(share, last) << budget;
    last = share;
  }
  EXPECT_GT(last, 0.02);
}

TEST_F(LevelsOfQuality, StayFiniteWhereThereIsLittleOrAllToDo) {
  struct Tried {
    const char* scene;
    int64_t resolution;
    const char* structure;
    glm::ivec2 sizePx;
  };
  for (const Tried& tried :
       {Tried{"two_boxes", 1, "hsm", {13, 7}}, Tried{"two_boxes", 2, "mssm", {1, 1}},
        Tried{"two_boxes", 64, "none", {17, 9}}, Tried{"degenerate_soup", 64, "ysm", {33, 9}},
        Tried{"half_plane", 64, "mssm", {1, 40}}}) {
    const scene::Scene scene = makeScene(tried.scene);
    for (const int64_t budget : {0, 1, 25}) {
      Given given = {{"passes", text("split")},
                     {"levels", text("blend")},
                     {"budget.limit", budget},
                     {"resolution", tried.resolution},
                     {"structure", text(tried.structure)}};
      if (std::string(tried.structure) == "ysm") given["structure.base"] = int64_t{64};
      const Graded graded = grade(scene, kArea, given, tried.sizePx);
      for (const float value : graded.visibility.data) {
        ASSERT_GE(value, 0.0F) << tried.scene;
        ASSERT_LE(value, 1.0F) << tried.scene;
      }
      int processed = 0;
      for (size_t i = 0; i < graded.visibility.pixels(); ++i) processed += graded.kind(i) == Processed;
      // Without a structure nothing is lit or in umbra but what looks past the map.
      if (std::string(tried.structure) == "none") {
        EXPECT_GT(processed, 0);
        EXPECT_EQ(graded.counters.at("umbra_share"), 0.0);
      }
    }
  }
}

TEST_F(LevelsOfQuality, NothingToProcessLeavesAllLit) {
  const scene::Scene scene = makeScene("half_plane", {{"edge_height", 1.0}});
  scene::Scene empty = scene;
  // The card goes: the ground has nothing between it and the light.
  for (const scene::Part& part : empty.parts)
    if (part.name == "half_plane")
      for (uint32_t i = 0; i < part.triangleCount; ++i)
        empty.mesh.triangles[part.firstTriangle + i] = glm::uvec3(empty.mesh.triangles[part.firstTriangle].x);
  const Graded graded =
      grade(empty, kArea, {{"passes", text("split")}, {"levels", text("blend")}, {"resolution", int64_t{64}}},
            {20, 20});
  for (const float value : graded.visibility.data) ASSERT_EQ(value, 1.0F);
  EXPECT_EQ(graded.counters.at("processed_share"), 0.0);
  EXPECT_EQ(graded.counters.at("examined_per_px"), 0.0);
}

TEST_F(LevelsOfQuality, WhatBelongsToAnotherChoiceCannotBeWritten) {
  const auto known = [](const Given& given) {
    try {
      const ParameterValues values(TechniqueRegistry::instance().get(kArea).parameters, given);
      return true;
    } catch (const Error&) {
      return false;
    }
  };
  EXPECT_TRUE(known({{"levels", text("blend")}}));
  EXPECT_TRUE(known({{"levels", text("blend")}, {"passes", text("split")}}));
  EXPECT_TRUE(known({{"passes", text("split")}, {"passes.smoothing.radius", int64_t{3}}}));
  // Levels are smoothed between passes, and only real ones follow from a source.
  EXPECT_FALSE(known({{"passes", text("single")}, {"passes.smoothing.radius", int64_t{3}}}));
  EXPECT_FALSE(known({{"passes", text("single")}, {"passes.order", text("loop_length")}}));
  EXPECT_FALSE(known({{"levels", text("blend")}, {"levels.width", 0.2}}));
  EXPECT_FALSE(known({{"levels.source", text("filtered_depth")}}));
  EXPECT_FALSE(known({{"budget.inner", 0.5}}));
  // A rim needs a budget to fall from.
  EXPECT_FALSE(known({{"budget", text("radial")}, {"budget.centre", int64_t{0}}}));
  const std::optional<Error> error = refusal(kArea, {{"budget", text("radial")}, {"budget.inner", 2.0}});
  ASSERT_TRUE(error);
  EXPECT_EQ(error->where(), "budget.outer");
}

}  // namespace
}  // namespace limen::techniques
