// SPDX-License-Identifier: BSD-3-Clause
#include "perception/threshold_maps/threshold_map_gpu.h"

#include <gtest/gtest.h>

#include <set>

#include "experiments/base/error.h"
#include "perception/threshold_maps/model.h"
#include "perception/threshold_maps/reference.h"
#include "perception/threshold_maps/threshold_map_bindings.h"
#include "perception/vision/castle_csf.h"
#include "tests/perception/threshold_maps/edge_support.h"
#include "tests/perception/threshold_maps/patterns.h"
#include "tests/renderer/gl/gl_fixture.h"

namespace limen::perception {
namespace {

using Given = std::map<std::string, ParameterValue>;

std::string text(const char* value) { return value; }

class ThresholdMapGpuTest : public gl::GlTest {
 protected:
  static DisplayProfile display() { return displayPreset("schwarz_2009"); }

  static Image gpuMap(const Plane& luminance, const ThresholdMapSettings& settings, Image* stages = nullptr,
                      const ThresholdMapGpuSettings& form = {}) {
    gl::Texture input(gl::Format::R32F, {luminance.width, luminance.height});
    input.write(toImage(luminance));
    ThresholdMapGpu gpu(context(), input.sizePx(), display(), settings, form, false);
    if (stages) gpu.keepStages();
    gpu.run(input);
    if (stages) *stages = gpu.debugViews().at("stages")->read();
    return gpu.map().read();
  }

  /// Largest relative error of a pixel's threshold against the double-precision map of the same settings,
  /// less what rounding of the luminance to 24 bits makes of faint patterns: it moves the finest band's
  /// contrast by 2^-24, which counts with that band's elevation F.
  static double largestError(const Plane& luminance, const ThresholdMapSettings& settings,
                             const std::string& name, const ThresholdMapGpuSettings& form = {}) {
    const Image map = gpuMap(luminance, settings, nullptr, form);
    const ThresholdMap exact = computeThresholdMap(luminance, display().pixelsPerDegree(), settings);
    const ThresholdModel model(settings, display().pixelsPerDegree(), luminance.width, luminance.height);
    const auto* smooth = std::get_if<SmoothFlat>(&settings.flat);
    double largest = 0.0;
    for (size_t i = 0; i < map.data.size(); ++i) {
      EXPECT_TRUE(std::isfinite(map.data[i])) << name;
      // On a step of the TVI rounding decides on which side a pixel lies. Above castleCSF's kink
      // sensitivities change with the fifth root of the distance: 2e-6 of the luminance, a few roundings,
      // moves them by percents.
      const double adaptation = exact.adaptationCdM2.data[i], lg = std::log10(std::max(adaptation, 1e-9));
      if (std::abs(lg + 1.44) < 2e-5 || std::abs(lg - 1.9) < 2e-5) continue;
      if (settings.csf == "castlecsf" && std::abs(adaptation / castleKinkCdM2() - 1.0) < 2e-6) continue;
      double sum = smooth ? smooth->epsilon : 1e-4;
      for (const Plane& contrast : exact.contrasts) sum += contrast.data[i];
      const double rounding =
          model.bands() > 0 ? std::ldexp(model.frequencyElevation(0, adaptation) / sum, -24) : 0.0;
      largest = std::max(largest, std::abs(map.data[i] / exact.thresholdCdM2.data[i] - 1.0) - rounding);
    }
    return largest;
  }
};

TEST_F(ThresholdMapGpuTest, APartOfTheMapIsThatPartOfTheWholeMap) {
  const Plane luminance = picture(201, 143);
  gl::Texture input(gl::Format::R32F, {201, 143});
  input.write(toImage(luminance));
  ThresholdMapGpu gpu(context(), input.sizePx(), display(), {}, {}, false);
  const Image whole = gpu.run(input).read();
  gl::Texture flat(gl::Format::R32F, {201, 143});
  flat.clear(glm::vec4(50.0F));
  for (const MapArea area :
       {MapArea{{70, 40}, {90, 80}}, MapArea{{0, 0}, {1, 1}}, MapArea{{190, 100}, {201, 143}}}) {
    gpu.run(flat);  // so that nothing is left of the last run
    const Image part = gpu.run(input, nullptr, area).read();
    for (int y = area.low.y; y < area.high.y; ++y)
      for (int x = area.low.x; x < area.high.x; ++x)
        ASSERT_EQ(part.data[size_t(y) * 201 + size_t(x)], whole.data[size_t(y) * 201 + size_t(x)])
            << x << ", " << y;
  }
}

TEST_F(ThresholdMapGpuTest, AgreesWithTheReferenceOnAdversarialImages) {
  // Of the pyramid those alone on which it differs most from the stack: every variant is a program to
  // compile.
  const std::set<std::string> both = {"faint ramp", "spike in the dark", "prime sizes", "single pixel"};
  for (const auto& [name, image] : adversarialPatterns())
    for (const char* decomposition : {"stack", "pyramid"})
      for (const int precision : {32, 16}) {
        if (text(decomposition) == "pyramid" && !both.count(name)) continue;
        const ThresholdMapSettings settings = settingsOf({{"decomposition", text(decomposition)}});
        EXPECT_LT(largestError(image, settings, name, {.precision = precision}),
                  precision == 16 ? 0.02 : 0.005)
            << name << ' ' << decomposition << ' ' << precision;
      }
}

TEST_F(ThresholdMapGpuTest, AgreesWithTheReferenceForEverySetting) {
  // Number of levels, adaptation level and direct evaluation are compiled in; the rest are tables and
  // uniforms.
  const std::vector<Given> variants = {
      {{"model", text("schwarz_2009")}},
      {{"stimulus_area", text("image")}},
      {{"levels", int64_t{3}},
       {"adaptation", text("level")},
       {"adaptation.level", int64_t{0}},
       {"frequency_elevation.low", text("one")}},
      {{"levels", int64_t{8}}, {"border", text("mirror")}},
      {{"downsample", text("burt")}, {"downsample.centre", 0.5}, {"peak_model", text("with_upsample")}},
      {{"adaptation", text("nearest_level")}, {"frequency_elevation", text("original")}},
      {{"adaptation", text("fractional_level")},
       {"frequency_elevation", text("none")},
       {"gain_compensation", true}},
      {{"masking", text("none")}, {"csf", text("barten03")}, {"tvi", text("from_csf")}},
      {{"masking", text("self")}, {"tvi", text("ward_smoothed")}},
      {{"masking", text("schwarz")}, {"tvi_factor", 1.0}}};
  const std::string thesis = "schwarz_2009";
  const std::vector<Given> direct = {{{"model", thesis}},
                                     {{"model", thesis}, {"frequency_elevation", text("original")}},
                                     {{"model", thesis}, {"frequency_elevation.low", text("one")}}};
  const Plane image = picture(150, 101);
  const auto compare = [&](const Given& given, ThresholdLookup lookup) {
    std::string name = toText(lookup);
    for (const auto& [key, value] : given) name += " " + key + " " + toText(value);
    EXPECT_LT(largestError(image, settingsOf(given), name, {.lookup = lookup}), 0.005) << name;
  };
  for (const Given& given : variants) compare(given, ThresholdLookup::Tables);
  for (const Given& given : direct) compare(given, ThresholdLookup::Direct);
}

TEST_F(ThresholdMapGpuTest, AFlatFieldHasItsExactThreshold) {
  // Every size, every precision: 0.2 10^(2 - 1.255).
  for (const glm::ivec2 size : {glm::ivec2(1, 1), {64, 64}, {101, 67}, {1, 40}})
    for (const int precision : {32, 16}) {
      const Image map = gpuMap(Plane(size.x, size.y, 100.0), settingsOf(), nullptr, {.precision = precision});
      for (const float value : map.data) ASSERT_NEAR(value, 1.111809, 2e-5);
    }
}

TEST_F(ThresholdMapGpuTest, AgreesWithTheReferenceAboutTheKinkOfCastleCsf) {
  ASSERT_EQ(settingsOf().csf, "castlecsf");
  const double kink = castleKinkCdM2();
  // Every cell of the tables about it, flat and beside contrasts.
  EXPECT_LT(largestError(pattern(400, 8, [](int x, int) { return 0.0105 + 1e-5 * x; }), settingsOf(), "ramp"),
            0.005);
  EXPECT_LT(largestError(
                pattern(400, 64, [](int x, int y) { return (0.0105 + 1e-5 * x) * (y / 3 % 2 ? 1.3 : 0.7); }),
                settingsOf(), "stripes"),
            0.005);
  for (const double distance : {-1e-5, 1e-5, 1e-3})
    EXPECT_LT(largestError(pattern(16, 16, [&](int, int) { return kink * (1.0 + distance); }), settingsOf(),
                           "flat"),
              0.005)
        << distance;
  EXPECT_NEAR(kKinkCdM2, kink, 1e-9);
}

TEST_F(ThresholdMapGpuTest, LevelsEqualTheDoublePyramid) {
  // However many levels a pass makes; sizes that halve evenly, and sizes that do not.
  for (const int perPass : {1, 2, 3})
    for (const char* border : {"clamp", "mirror"})
      for (const auto& [width, height] : {std::pair(256, 128), {263, 67}, {211, 90}}) {
        const Plane image = noisePattern(width, height);
        gl::Texture input(gl::Format::R32F, {width, height});
        input.write(toImage(image));
        const ThresholdMapSettings settings = settingsOf({{"border", text(border)}});
        ThresholdMapGpu gpu(context(), {width, height}, display(), settings,
                            {.levelsPerPass = GivenLevels{perPass}}, false);
        gpu.run(input);
        const std::vector<Plane> pyramid = gaussianPyramid(image, settings.pyramid());
        for (int level = 1; level < gpu.levels(); ++level) {
          const Image read = gpu.debugViews().at("gaussian")->read(level - 1);
          for (size_t i = 0; i < read.data.size(); ++i)
            ASSERT_NEAR(read.data[i] / pyramid[static_cast<size_t>(level)].data[i], 1.0, 1e-6)
                << width << ' ' << level << ' ' << perPass;
        }
      }
}

TEST_F(ThresholdMapGpuTest, NineFetchesEqualThirtySixTapsWhereSizesAreEven) {
  const Plane image = noisePattern(128, 64);
  gl::Texture input(gl::Format::R32F, {128, 64});
  input.write(toImage(image));
  ThresholdMapSettings settings = settingsOf({{"downsample", text("nine_fetch")}});
  ThresholdMapGpu gpu(context(), {128, 64}, display(), settings, {}, false);
  gpu.run(input);
  settings.downsample = BinomialKernel{};
  const std::vector<Plane> pyramid = gaussianPyramid(image, settings.pyramid());
  for (int level = 1; level < 5; ++level) {
    const Image read = gpu.debugViews().at("gaussian")->read(level - 1);
    for (size_t i = 0; i < read.data.size(); ++i)
      ASSERT_NEAR(read.data[i] / pyramid[static_cast<size_t>(level)].data[i], 1.0, 0.01) << level;
  }
}

TEST_F(ThresholdMapGpuTest, NineFetchesOfOddSizesAreTheReferencesNineFetches) {
  // Weights of a bilinear fetch have 8 bits: contrasts of neighbouring levels move by some 1/256 of
  // differences between texels, so a smooth image is compared.
  const Plane image =
      pattern(101, 67, [](int x, int y) { return 60.0 + 40.0 * std::sin(0.15 * x) * std::cos(0.11 * y); });
  const Given nineFetch = {{"downsample", text("nine_fetch")}};
  const ThresholdMapSettings thesis = thesisOf(nineFetch), castle = settingsOf(nineFetch);
  EXPECT_LT(largestError(image, thesis, "nine fetches"), 0.02);
  // The same fetches move contrasts by the same amounts, most of all the finest band's beside what it holds;
  // castleCSF's map answers that more: how much more, say the models.
  const auto response = [&](const ThresholdMapSettings& settings) {
    const ThresholdMap map = computeThresholdMap(image, display().pixelsPerDegree(), settings);
    const ThresholdModel model(settings, display().pixelsPerDegree(), 101, 67);
    double largest = 0.0;
    for (size_t i = 0; i < map.elevation.data.size(); ++i) {
      std::vector<double> contrasts;
      for (const Plane& contrast : map.contrasts) contrasts.push_back(contrast.data[i]);
      contrasts[0] += 1e-4;
      const double moved = model.elevation(contrasts, map.adaptationCdM2.data[i]);
      largest = std::max(largest, std::abs(moved / map.elevation.data[i] - 1.0));
    }
    return largest;
  };
  EXPECT_LT(largestError(image, castle, "nine fetches"), 0.02 * response(castle) / response(thesis));
}

TEST_F(ThresholdMapGpuTest, NineFetchesIn16BitsHoldFaintContrasts) {
  // Luminance itself in 16 bits has steps of 1/16 cd/m2 at 100 cd/m2: contrasts of 0.03 % are all rounding.
  // Less its mean, it has steps of 2^-11 of the distance from there.
  const ThresholdMapSettings settings = thesisOf({{"downsample", text("nine_fetch")}});
  for (const double contrast : {0.001, 0.01, 0.1}) {
    const Plane image = pattern(128, 128, [&](int x, int y) {
      return 100.0 * (1.0 + contrast * std::sin(0.35 * x) * std::cos(0.23 * y));
    });
    // Against 32 bits on the same GPU: weights of its bilinear fetches may have 8 bits, which band 0, a small
    // difference, shows in both.
    const Image half = gpuMap(image, settings, nullptr, {.precision = 16}),
                full = gpuMap(image, settings, nullptr, {.precision = 32});
    for (size_t i = 0; i < half.data.size(); ++i)
      ASSERT_NEAR(half.data[i] / full.data[i], 1.0, 0.03) << contrast;
  }
}

TEST_F(ThresholdMapGpuTest, LuminanceStoredInPlaceOfTheFinestBandIsAsExact) {
  for (const auto& [name, image] : adversarialPatterns())
    EXPECT_LT(largestError(image, settingsOf(), name, {.finest = FinestStored::Luminance}), 0.005) << name;
  for (const char* name : {"faint ramp", "picture"})
    EXPECT_LT(
        largestError(adversarialPatterns().at(name), settingsOf(), name, {.finest = FinestStored::Band}),
        0.005)
        << name;
}

TEST_F(ThresholdMapGpuTest, EvenSizesAreReducedLikeAllOthers) {
  // Sizes whose levels are even twice, once and not at all, with one level a pass as for large images.
  for (const glm::ivec2 size : {glm::ivec2(256, 192), {136, 88}, {150, 90}, {130, 62}})
    for (const char* border : {"clamp", "mirror"}) {
      const Plane image = noisePattern(size.x, size.y);
      for (const std::variant<AutomaticLevels, GivenLevels>& perPass :
           {std::variant<AutomaticLevels, GivenLevels>(), {GivenLevels{1}}})
        EXPECT_LT(largestError(image, settingsOf({{"border", text(border)}}), border,
                               {.levelsPerPass = perPass, .finest = FinestStored::Luminance}),
                  0.005);
    }
}

TEST_F(ThresholdMapGpuTest, ColourIsTurnedIntoTheDisplaysLuminance) {
  Image colour(70, 40, 4);
  for (size_t i = 0; i < colour.data.size(); ++i) colour.data[i] = static_cast<float>((i * 37 % 101) / 80.0);
  colour.data[0] = std::nanf("");
  colour.data[5] = -1.0F;
  colour.data[10] = HUGE_VALF;
  gl::Texture input(gl::Format::RGBA32F, {70, 40});
  input.write(colour);
  ThresholdMapGpu gpu(context(), {70, 40}, display(), settingsOf(), {}, true);
  const Image map = gpu.run(input).read();
  const ThresholdMap exact =
      computeThresholdMap(luminancePlane(colour, display()), display().pixelsPerDegree(), settingsOf());
  for (size_t i = 0; i < map.data.size(); ++i)
    EXPECT_NEAR(map.data[i] / exact.thresholdCdM2.data[i], 1.0, 0.005) << i;
}

TEST_F(ThresholdMapGpuTest, AdaptsToOneDegree) {
  Image stages;
  for (const char* decomposition : {"stack", "pyramid"}) {
    const Plane edge = edgePattern(512, 64);
    gpuMap(edge, settingsOf({{"decomposition", text(decomposition)}}), &stages);
    Plane adaptation(512, 64);
    for (size_t i = 0; i < adaptation.data.size(); ++i) adaptation.data[i] = stages.data[2 * i];
    EXPECT_NEAR(edgeSupportPx(adaptation) / display().pixelsPerDegree(), 1.0, 0.2) << decomposition;
  }
}

TEST_F(ThresholdMapGpuTest, StagesAreThoseOfTheReference) {
  const Plane image = picture(120, 90);
  Image stages;
  gpuMap(image, settingsOf(), &stages);
  const ThresholdMap exact = computeThresholdMap(image, display().pixelsPerDegree(), settingsOf());
  for (size_t i = 0; i < image.data.size(); ++i) {
    EXPECT_NEAR(stages.data[2 * i] / exact.adaptationCdM2.data[i], 1.0, 1e-5);
    EXPECT_NEAR(stages.data[2 * i + 1] / exact.elevation.data[i], 1.0, 0.005);
  }
}

TEST_F(ThresholdMapGpuTest, GivesTheSameBytesTwice) {
  const Plane image = noisePattern(150, 90);
  EXPECT_EQ(gpuMap(image, settingsOf()).data, gpuMap(image, settingsOf()).data);
}

TEST_F(ThresholdMapGpuTest, RefusesWhatOnlyTheReferenceKnows) {
  const auto make = [&](const Given& given, const ThresholdMapGpuSettings& form = {}) {
    ThresholdMapGpu(context(), {32, 32}, display(), settingsOf(given), form, false);
  };
  EXPECT_THROW(make({{"decomposition", text("true_stack")}}), Error);
  EXPECT_THROW(make({{"decomposition", text("repeated")}}), Error);
  EXPECT_THROW(make({{"adaptation", text("mistaken_degree")}}), Error);
  EXPECT_THROW(make({{"decomposition.upsampler", text("expand")}}), Error);
  EXPECT_THROW(make({{"csf", text("barten03")}}, {.lookup = ThresholdLookup::Direct}), Error);
}

}  // namespace
}  // namespace limen::perception
