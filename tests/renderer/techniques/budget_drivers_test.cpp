// SPDX-License-Identifier: BSD-3-Clause
// Drivers of the budget: their maps worked out again in double precision from what they are defined by.
#include <cmath>
#include <cstring>
#include <filesystem>

#include "experiments/base/error.h"
#include "experiments/base/image_file.h"
#include "perception/threshold_maps/reference.h"
#include "perception/thresholds/thresholds.h"
#include "renderer/frame/shaded.h"
#include "renderer/techniques/soft_shadows/quality/painted_budget.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

constexpr const char* kSteered = "soft_shadows/backprojection";

struct Steered {
  Image visibility, budgets, receivers, picture, direct;
  std::map<std::string, double> counters;
};

class BudgetDrivers : public TechniqueTest {
 protected:
  static ParameterValue named(const std::string& value) { return value; }

  static Given with(Given given, const Given& more) {
    for (const auto& [name, value] : more) given[name] = value;
    return given;
  }

  /// The parameter of a driver that is the most any pixel may take.
  static std::string most(const std::string& name) {
    static const std::map<std::string, std::string> kMost = {
        {"uniform", "limit"}, {"radial", "centre"},   {"masking", "plain"},
        {"painted", "white"}, {"perceptual", "most"}, {"frame_time", "base.limit"}};
    return kMost.at(name);
  }

  static Given driver(const std::string& name, const Given& more = {}) {
    return with({{"resolution", int64_t{128}},
                 {"structure", named("mssm")},
                 {"budget", named(name)},
                 {"budget." + most(name), int64_t{144}}},
                more);
  }

  /// A picture by `ambient` and 0.8 of direct light, and the direct light alone, beside it.
  static Steered steer(const scene::Scene& scene, const Given& given, glm::ivec2 sizePx,
                       double ambient = 0.2) {
    const TechniqueInfo& info = TechniqueRegistry::instance().get(kSteered);
    const ParameterValues values(info.parameters, given);
    info.check(values);
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, sizePx);
    const auto made = info.make(values);
    made->prepare(frame);
    frame.begin();
    made->render(frame);
    Steered out;
    out.visibility = made->product().read();
    const auto views = made->debugViews();
    if (views.count("budget_map")) out.budgets = views.at("budget_map")->read();
    out.receivers = frame.get<frame::Receivers>().texture().read();
    frame::ShadedSetting setting;
    setting.ambient = ambient;
    out.picture = frame.get<frame::Shaded>(setting).texture().read();
    setting.ambient = 0.0;
    setting.background = 0.0;
    out.direct = frame.get<frame::Shaded>(setting).texture().read();
    frame.end();
    for (const Counter& counter : made->count(frame)) out.counters[counter.name] = counter.value;
    return out;
  }

  /// Columns on a ground that is plain or textured.
  static scene::Scene hall(double contrast) {
    scene::Scene scene = makeScene("columns_hall", {{"columns_per_row", int64_t{2}}});
    scene::Pattern& pattern = scene.materials[scene.parts[0].material].pattern;
    if (contrast > 0.0)
      pattern = {scene::Pattern::Kind::Checker, 1.1, contrast, 1, glm::dvec3(0.0, -0.5, 0.0)};
    return scene;
  }

  static std::string folder() {
    const auto path = std::filesystem::path(testing::TempDir()) / "limen_budget_drivers";
    std::filesystem::create_directories(path);
    return path.string();
  }

  /// Whether the values exist together at all, and none is missing.
  static bool canBeWritten(const Given& given) {
    try {
      const ParameterValues values(TechniqueRegistry::instance().get(kSteered).parameters, given);
      return true;
    } catch (const Error&) {
      return false;
    }
  }

  static std::string refused(const Given& given) {
    const std::optional<Error> error = refusal(kSteered, given);
    return error ? error->where() : std::string();
  }
};

double luminanceAt(const Image& picture, size_t pixel) {
  const float* rgb = &picture.data[4 * pixel];
  return 0.2126729 * rgb[0] + 0.7151522 * rgb[1] + 0.0721750 * rgb[2];
}

/// RMS contrast of the receivers in a window, from its definition.
double contrastAt(const Steered& steered, int atX, int atY, int radius) {
  const int width = steered.receivers.width, height = steered.receivers.height;
  std::vector<double> seen;
  for (int y = std::max(atY - radius, 0); y <= std::min(atY + radius, height - 1); ++y)
    for (int x = std::max(atX - radius, 0); x <= std::min(atX + radius, width - 1); ++x) {
      const auto i = static_cast<size_t>(y * width + x);
      if (steered.receivers.data[4 * i + 3] >= 0.0F) seen.push_back(luminanceAt(steered.direct, i));
    }
  double mean = 0.0, squares = 0.0;
  for (const double value : seen) mean += value / double(seen.size());
  for (const double value : seen) squares += (value - mean) * (value - mean) / double(seen.size());
  return mean > 0.0 ? std::sqrt(squares) / mean : 0.0;
}

// Float sums of up to 9 and 9 terms around their means: contrasts to some 1e-6 of themselves and of 1. The
// root falls by 7 over 0.3 of contrast, so by 24 of the budget at most for 0.04: errors of the budget below
// 1e-3.
TEST_F(BudgetDrivers, MaskingFollowsTheContrastOfTheWindow) {
  const scene::Scene scene = hall(0.8);
  const double low = 0.1, high = 0.4;
  const int radius = 4;
  for (const glm::ivec2 size : {glm::ivec2(80, 60), glm::ivec2(13, 7), glm::ivec2(1, 1)}) {
    const Steered steered = steer(scene,
                                  driver("masking", {{"budget.radius", int64_t{radius}},
                                                     {"budget.low_contrast", low},
                                                     {"budget.high_contrast", high}}),
                                  size);
    int least = 0, most = 0, between = 0;
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) {
        const double contrast = contrastAt(steered, x, y, radius);
        const double root = 12.0 - 7.0 * std::clamp((contrast - low) / (high - low), 0.0, 1.0);
        const double found = steered.budgets.at(x, y);
        ASSERT_NEAR(found, root * root, 1e-3) << x << ' ' << y;
        ++(found == 25.0 ? least : found == 144.0 ? most : between);
      }
    if (size.x < 16) continue;
    EXPECT_GT(least, 100);
    EXPECT_GT(most, 100);
    EXPECT_GT(between, 100);
  }
}

TEST_F(BudgetDrivers, MaskingSparesPlainGround) {
  const glm::ivec2 size(80, 60);
  const Given given = driver("masking");
  const Steered plain = steer(hall(0.0), given, size), textured = steer(hall(0.8), given, size);
  const auto at = [](const Steered& steered, const char* name) { return steered.counters.at(name); };
  EXPECT_GT(at(plain, "budget_per_px"), at(textured, "budget_per_px"));
  EXPECT_GT(at(plain, "examined_per_px"), at(textured, "examined_per_px"));
}

// A tent reproduces what is constant, and what is linear away from the borders; samples of equal size are its
// own centres.
TEST_F(BudgetDrivers, PaintedWeightsAreResampled) {
  Image ramp(12, 9, 1);
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 12; ++x) ramp.at(x, y) = static_cast<float>((x + 0.5) / 12.0);
  EXPECT_EQ(paintedWeights(ramp, {12, 9}, PaintedFit::Refuse).data, ramp.data);
  for (const glm::ivec2 size : {glm::ivec2(4, 3), glm::ivec2(16, 12), glm::ivec2(48, 36), glm::ivec2(7, 5)}) {
    const Image flat = paintedWeights(Image(12, 9, 1, 0.25F), size, PaintedFit::Stretch);
    for (const float value : flat.data) ASSERT_FLOAT_EQ(value, 0.25F);
    const Image sized = paintedWeights(ramp, size, PaintedFit::Stretch);
    // The filter reaches a texel or a pixel, whichever is larger, beyond a pixel's centre.
    const double margin = std::max(1.0 / 12.0, 1.0 / size.x) + 0.5 / 12.0;
    int inner = 0;
    for (int x = 0; x < size.x; ++x) {
      const double at = (x + 0.5) / size.x;
      if (at < margin || at > 1.0 - margin) continue;
      // A tent over few samples is off its centre by a part of a texel, unless both grids agree.
      ASSERT_NEAR(sized.at(x, 0), at, size.x >= 12 ? 1e-6 : 0.5 / 12.0) << size.x << ' ' << x;
      ++inner;
    }
    EXPECT_GT(inner, 0);
  }
  // One factor for both axes: the middle 2 x 2 of a 4 x 2 image.
  Image wide(4, 2, 1);
  wide.data = {0.0F, 0.25F, 0.5F, 1.0F, 0.125F, 0.375F, 0.625F, 0.875F};
  EXPECT_EQ(paintedWeights(wide, {2, 2}, PaintedFit::Cover).data,
            (std::vector<float>{0.25F, 0.5F, 0.375F, 0.625F}));
  EXPECT_EQ(paintedWeights(wide, {1, 1}, PaintedFit::Stretch).pixels(), 1U);
  EXPECT_THROW(paintedWeights(wide, {2, 2}, PaintedFit::Refuse), Error);
  // 40 x 30 at a quarter of 4:3 frames whose sides are not whole multiples.
  EXPECT_NO_THROW(paintedWeights(Image(13, 10, 1), {40, 30}, PaintedFit::Refuse));
}

TEST_F(BudgetDrivers, PaintedIsTheImagesRoots) {
  const std::string path = folder() + "/weights.exr";
  Image weights(24, 18, 1);
  for (size_t i = 0; i < weights.pixels(); ++i) weights.data[i] = static_cast<float>(i % 25) / 24.0F;
  writeExr(path, weights);
  const scene::Scene scene = hall(0.0);
  const Steered steered = steer(scene, driver("painted", {{"budget.file", named(path)}}), {24, 18});
  for (size_t i = 0; i < weights.pixels(); ++i) {
    const double root = 5.0 + 7.0 * weights.data[i];
    ASSERT_NEAR(steered.budgets.data[i], root * root, 1e-4) << i;
  }
  // Other proportions, and no image at all.
  EXPECT_THROW(steer(scene, driver("painted", {{"budget.file", named(path)}}), {24, 24}), Error);
  EXPECT_NO_THROW(steer(
      scene, driver("painted", {{"budget.file", named(path)}, {"budget.fit", named("cover")}}), {24, 24}));
  try {
    steer(scene, driver("painted", {{"budget.file", named(folder() + "/none.png")}}), {24, 18});
    FAIL() << "an image that is not there was read";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("none.png"), std::string::npos) << error.what();
  }
  EXPECT_FALSE(canBeWritten(driver("painted")));
}

// The map on the GPU keeps its thresholds to 0.5 % and a step of 0.72 % (threshold_map_test.cpp); the budget
// goes with their square: 2.5 %.
TEST_F(BudgetDrivers, PerceptualMeetsTheThresholdsOfTheReference) {
  const perception::DisplayProfile display = perception::displayPreset("schwarz_2009");
  using perception::PredictorModel;
  const std::map<std::string, perception::ThresholdSettings> kinds = {
      {"single", perception::ThresholdMapSettings{}},
      {"schwarz_2009", perception::ThresholdMapSettings::preset(PredictorModel::Schwarz2009)},
      {"bands", perception::BandThresholdSettings{}}};
  for (const auto& [kind, contrast] : std::vector<std::pair<std::string, double>>{
           {"single", 0.0}, {"single", 0.6}, {"schwarz_2009", 0.6}, {"bands", 0.6}}) {
    const scene::Scene scene = hall(contrast);
    // Combined thresholds are far lower: smaller errors keep budgets between their limits.
    const double error = kind == "bands" ? 0.05 : 2.0;
    const Given given =
        driver("perceptual",
               {{"budget.most", int64_t{400}}, {"budget.error", error}, {"budget.threshold_map", kind}});
    const Steered steered = steer(scene, given, {90, 61});
    const perception::Thresholds reference = perception::computeThresholds(
        perception::luminancePlane(steered.picture, display), display, kinds.at(kind));
    const Image thresholds = perception::toImage(reference.thresholdCdM2);
    int between = 0;
    for (size_t i = 0; i < steered.budgets.pixels(); ++i) {
      const double light = luminanceAt(steered.direct, i) * (display.peakCdM2 - display.blackCdM2);
      const double root = std::clamp(error * light / thresholds.data[i], 5.0, 20.0);
      const double found = steered.budgets.data[i];
      ASSERT_NEAR(found / (root * root), 1.0, 0.025) << i;
      between += found > 25.5 && found < 399.0;
    }
    EXPECT_GT(between, 300) << kind << ' ' << contrast;
  }
}

TEST_F(BudgetDrivers, PerceptualSpendsLessWhereMoreIsMasked) {
  const glm::ivec2 size(96, 72);
  const Given given = driver("perceptual", {{"budget.most", int64_t{10000}}, {"budget.least", int64_t{1}}});
  const Steered plain = steer(hall(0.0), given, size), textured = steer(hall(0.6), given, size);
  // Of ground whose light is the same: what the texture's luminance itself does is not masking.
  double plainSum = 0.0, texturedSum = 0.0;
  int compared = 0;
  for (size_t i = 0; i < plain.budgets.pixels(); ++i) {
    const double direct = luminanceAt(plain.direct, i), other = luminanceAt(textured.direct, i);
    if (direct <= 0.0 || direct == other) continue;
    // Per unit of light, so that dark and bright squares compare: the inverse of the threshold.
    plainSum += std::sqrt(plain.budgets.data[i]) / direct;
    texturedSum += std::sqrt(textured.budgets.data[i]) / other;
    ++compared;
  }
  EXPECT_GT(compared, 500);
  EXPECT_LT(texturedSum, 0.8 * plainSum);
  // A larger error that may be made, or a smaller one that is, never costs more.
  for (const Given& more : {Given{{"budget.thresholds", 2.0}}, Given{{"budget.error", 1.0}}}) {
    const Steered fewer = steer(hall(0.0), with(given, more), size);
    int smaller = 0;
    for (size_t i = 0; i < fewer.budgets.pixels(); ++i) {
      ASSERT_LE(fewer.budgets.data[i], plain.budgets.data[i]);
      smaller += fewer.budgets.data[i] < plain.budgets.data[i];
    }
    EXPECT_GT(smaller, 1000);
  }
}

bool sameVisibility(const Steered& a, const Steered& b) {
  return a.visibility.data.size() == b.visibility.data.size() &&
         std::memcmp(a.visibility.data.data(), b.visibility.data.data(),
                     a.visibility.data.size() * sizeof(float)) == 0;
}

// Times that no frame can have, so that no clock decides.
TEST_F(BudgetDrivers, FrameTimeEndsAtTheLeastAndAtTheWholeBudget) {
  const scene::Scene scene = hall(0.0);
  const glm::ivec2 size(48, 36);
  const Steered none =
      steer(scene, driver("frame_time", {{"budget.target_ms", 1e-9}, {"budget.least", int64_t{9}}}), size);
  EXPECT_TRUE(sameVisibility(none, steer(scene, driver("uniform", {{"budget.limit", int64_t{9}}}), size)));
  EXPECT_NEAR(none.counters.at("budget_scale"), 9.0 / 144.0, 1e-12);
  EXPECT_GT(none.counters.at("frame_time_error_share"), 1.0);
  EXPECT_EQ(none.counters.at("frame_time_oscillations"), 0.0);
  const Steered all = steer(scene, driver("frame_time", {{"budget.target_ms", 1e9}}), size);
  EXPECT_TRUE(sameVisibility(all, steer(scene, driver("uniform"), size)));
  EXPECT_EQ(all.counters.at("budget_scale"), 1.0);
  EXPECT_LT(all.counters.at("frame_time_error_share"), 0.0);
}

TEST_F(BudgetDrivers, FrameTimeScalesAnotherMap) {
  const scene::Scene scene = hall(0.0);
  const glm::ivec2 size(48, 36);
  const Steered base = steer(scene, driver("radial", {{"budget.rim", int64_t{16}}}), size);
  Given scaled = driver("frame_time", {{"budget.target_ms", 1e-9},
                                       {"budget.least", int64_t{36}},
                                       {"budget.base", named("radial")},
                                       {"budget.base.centre", int64_t{144}},
                                       {"budget.base.rim", int64_t{16}}});
  scaled.erase("budget.base.limit");
  Given whole = scaled;
  whole["budget.dither"] = false;
  const Steered held = steer(scene, whole, size);
  // A quarter, but no less than 36, and what is below is left alone.
  for (size_t i = 0; i < base.budgets.pixels(); ++i)
    ASSERT_NEAR(held.budgets.data[i],
                std::max(0.25 * base.budgets.data[i], std::min(36.0, double{base.budgets.data[i]})), 1e-3);
  EXPECT_FALSE(canBeWritten(driver("frame_time", {{"budget.base.rim", int64_t{16}}})));
  EXPECT_EQ(refused(scaled), "");
}

// Roots of 30 are 5 or 6, and 5.477 on the mean; the sequence is spread so evenly that 1728 pixels are off by
// less than some ten of them.
TEST_F(BudgetDrivers, FrameTimeDithersBetweenWholeRoots) {
  const Steered steered = steer(
      hall(0.0), driver("frame_time", {{"budget.target_ms", 1e-9}, {"budget.least", int64_t{30}}}), {48, 36});
  double sum = 0.0;
  for (const float budget : steered.budgets.data) {
    ASSERT_TRUE(budget == 25.0F || budget == 36.0F) << budget;
    sum += std::sqrt(budget);
  }
  EXPECT_NEAR(sum / double(steered.budgets.pixels()), std::sqrt(30.0), 0.01);
}

TEST_F(BudgetDrivers, MapsStayWithinTheirBoundsWhateverTheScene) {
  const std::string path = folder() + "/dot.png";
  writePng(path, Image(1, 1, 1, 0.5F));
  struct Tried {
    const char* scene;
    glm::ivec2 sizePx;
  };
  for (const Tried& tried :
       {Tried{"degenerate_soup", {33, 9}}, Tried{"two_boxes", {13, 7}}, Tried{"two_boxes", {1, 1}}}) {
    const scene::Scene scene = makeScene(tried.scene);
    for (const std::string name : {"radial", "masking", "painted", "perceptual", "frame_time"}) {
      SCOPED_TRACE(testing::Message() << tried.scene << ' ' << tried.sizePx.x << ' ' << name);
      Given given = driver(name, {{"passes", named("split")}, {"levels", named("blend")}});
      if (name == "painted")
        given = with(given, {{"budget.file", named(path)}, {"budget.fit", named("stretch")}});
      if (name == "frame_time") given["budget.settle_frames"] = int64_t{3};
      const Steered steered = steer(scene, given, tried.sizePx);
      for (const float budget : steered.budgets.data) {
        ASSERT_GE(budget, 25.0F - 1e-4F);
        ASSERT_LE(budget, 144.0F + 1e-4F);
      }
      for (const float value : steered.visibility.data) {
        ASSERT_GE(value, 0.0F);
        ASSERT_LE(value, 1.0F);
      }
    }
  }
}

TEST_F(BudgetDrivers, RefuseWhatDoesNotGoTogether) {
  EXPECT_EQ(refused(driver("masking", {{"budget.masked", int64_t{400}}})), "budget.masked");
  EXPECT_EQ(refused(driver("masking", {{"budget.high_contrast", 0.01}})), "budget.high_contrast");
  EXPECT_EQ(refused(driver("frame_time", {{"budget.base.limit", int64_t{9}}})), "budget.least");
  EXPECT_EQ(refused(driver("masking", {{"levels", named("fixed")}, {"levels.level", int64_t{2}}})), "budget");
  EXPECT_EQ(refused(driver("frame_time")), "");
  // No limit at all, what belongs to another driver, no picture.
  EXPECT_FALSE(canBeWritten(driver("perceptual", {{"budget.most", int64_t{0}}})));
  EXPECT_FALSE(canBeWritten(driver("uniform", {{"budget.error", 0.1}})));
  Given painted = driver("frame_time", {{"budget.base", named("painted")}});
  painted.erase("budget.base.limit");
  EXPECT_FALSE(canBeWritten(painted));
}

}  // namespace
}  // namespace limen::techniques
