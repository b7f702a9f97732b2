// SPDX-License-Identifier: BSD-3-Clause
#include "perception/threshold_maps/model.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "experiments/base/error.h"
#include "perception/vision/csf_models.h"
#include "perception/vision/tvi.h"
#include "tests/perception/threshold_maps/patterns.h"

namespace limen::perception {
namespace {

std::string textValue(const char* value) { return value; }

TEST(ThresholdSettings, NameModelsThatExist) {
  for (const Parameter& parameter : ThresholdMapSettings::table().parameters()) {
    if (parameter.name == "csf") {
      for (const std::string& name : parameter.choices) EXPECT_NO_THROW(makeCsf(name)) << name;
    }
    if (parameter.name == "masking") {
      for (const std::string& name : parameter.choices) EXPECT_NO_THROW(makeMasking(name)) << name;
      EXPECT_EQ(parameter.choices.size(), MaskingRegistry::instance().names().size());
    }
  }
}

TEST(ThresholdSettings, DefaultsOfTheDeclarationsAreThoseOfTheStructure) {
  const ThresholdMapSettings declared = settingsOf(), plain;
  EXPECT_EQ(declared.levels, plain.levels);
  EXPECT_EQ(ThresholdMapSettings::table().write(declared), ThresholdMapSettings::table().write(plain));
  EXPECT_TRUE(std::holds_alternative<UpsampledStack>(declared.decomposition));
  EXPECT_TRUE(std::holds_alternative<OneDegreeAdaptation>(declared.adaptation));
}

TEST(ThresholdSettings, WhatMeansNothingCannotBeWritten) {
  EXPECT_THROW(settingsOf({{"downsample", textValue("nine_fetch")}, {"downsample.centre", 0.4}}), Error);
  EXPECT_THROW(settingsOf({{"adaptation.level", int64_t{3}}}), Error);
  EXPECT_THROW(settingsOf({{"frequency_elevation.luminance_cd_m2", 50.0}}), Error);
  EXPECT_THROW(
      settingsOf({{"decomposition", textValue("pyramid")}, {"decomposition.upsampler", textValue("expand")}}),
      Error);
}

TEST(ThresholdModel, FrequencyElevationsAreThePublishedOnes) {
  // F of Barten 1989 at given frequencies: ppd = frequency / 0.5 puts band 0, whose peak is Nyquist, there.
  const auto f = [](double cpd, double luminance, const char* rule) {
    const ThresholdModel model(thesisOf({{"frequency_elevation", textValue(rule)}}), 2.0 * cpd, 64, 64);
    return model.frequencyElevation(0, luminance);
  };
  EXPECT_NEAR(f(5, 100, "actual"), 1.1002899108504425, 1e-6);
  EXPECT_NEAR(f(10, 35, "actual"), 2.3259610775083332, 1e-6);
  EXPECT_NEAR(f(20, 1, "actual"), 54.361937397598020, 1e-5);
  EXPECT_NEAR(f(20, 100, "original"), 6.7355658087932172, 1e-6);
  EXPECT_NEAR(f(20, 1, "original"), 6.7355658087932172, 1e-6);
  EXPECT_NEAR(f(0.6, 100, "actual"), 2.3478667671966528, 1e-6);
  EXPECT_EQ(f(0.6, 100, "original"), 1.0);  // below 4 cpd
  EXPECT_EQ(f(20, 100, "none"), 1.0);
}

TEST(ThresholdModel, FrequencyElevationsAreThoseOfTheReferenceVectors) {
  std::ifstream file(LIMEN_SOURCE_DIR "/tests/perception/reference/vision_vectors.csv");
  int rows = 0;
  for (std::string line; std::getline(file, line);) {
    const bool original = line.rfind("F_orig,", 0) == 0;
    if (!original && line.rfind("F_actualL,", 0) != 0) continue;
    std::vector<std::string> cells;
    std::stringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    const ThresholdModel model(
        thesisOf({{"frequency_elevation", textValue(original ? "original" : "actual")}}),
        2.0 * std::stod(cells[1]), 64, 64);
    const double expected = std::stod(cells[7]);
    EXPECT_NEAR(model.frequencyElevation(0, original ? 7.0 : std::stod(cells[2])) / expected, 1.0, 1e-9)
        << line;
    ++rows;
  }
  EXPECT_GT(rows, 10);
}

TEST(ThresholdModel, LowFrequencyRuleCanBeSetEitherWay) {
  // Band 2 of the six-tap pyramid at 41.07 ppd peaks at 2.459 cpd.
  const ThresholdModel one(thesisOf({{"frequency_elevation.low", textValue("one")}}), kStudyPpd, 256, 256);
  const ThresholdModel computed(thesisOf({{"frequency_elevation", textValue("original")},
                                          {"frequency_elevation.low", textValue("as_computed")}}),
                                kStudyPpd, 256, 256);
  EXPECT_NEAR(one.peaks()[2].frequencyCpd(kStudyPpd), 2.459, 0.001);
  EXPECT_EQ(one.frequencyElevation(2, 30.0), 1.0);
  EXPECT_GT(one.frequencyElevation(1, 30.0), 1.0);
  EXPECT_NEAR(computed.frequencyElevation(2, 1e-3),
              525.2 / csfBarten89(computed.peaks()[2].frequencyCpd(kStudyPpd), 100.0), 1e-3);
}

TEST(ThresholdModel, PeakSensitivityIsThatOfTheSearch) {
  for (const char* name : {"barten89", "castlecsf"}) {
    const ThresholdModel model(settingsOf({{"csf", textValue(name)}}), kStudyPpd, 64, 64);
    const auto csf = makeCsf(name);
    // 0.0113 cd/m2: where castleCSF's transient mechanism starts to respond to flicker at once.
    for (const double luminance : {0.00123, 0.01129, 0.0113, 0.0114, 0.0116, 0.013, 0.0456, 0.789, 1.0, 7.7,
                                   83.0, 250.0, 999.0, 4321.0}) {
      CsfPoint point;
      point.luminanceCdM2 = luminance;
      point.areaDeg2 = 7.07;
      EXPECT_NEAR(model.peakSensitivity(luminance) / csf->peak(point).sensitivity, 1.0, 1e-7)
          << name << ' ' << luminance;
    }
  }
}

TEST(ThresholdModel, AreaOfTheStimulusIsThatOfTheImageOrGiven) {
  // Of 64 x 32 pixels at 16 per degree: 4 x 2 degrees.
  CsfPoint point;
  point.frequencyCpd = 8.0;
  point.luminanceCdM2 = 30.0;
  const auto castle = makeCsf("castlecsf");
  const auto sensitivity = [](const ThresholdMapSettings& settings) {
    return ThresholdModel(settings, 16.0, 64, 32).sensitivity(0, 30.0);
  };
  point.areaDeg2 = 7.07;
  EXPECT_DOUBLE_EQ(sensitivity({}), castle->sensitivity(point));
  point.areaDeg2 = 8.0;
  EXPECT_DOUBLE_EQ(sensitivity(settingsOf({{"stimulus_area", textValue("image")}})),
                   castle->sensitivity(point));
  point.areaDeg2 = 1.5;
  EXPECT_DOUBLE_EQ(sensitivity(settingsOf({{"stimulus_area.deg2", 1.5}})), castle->sensitivity(point));
}

TEST(ThresholdSettings, TheThesissModelIsAPreset) {
  const ThresholdMapSettings thesis = thesisOf();
  EXPECT_EQ(thesis.csf, "barten89");
  EXPECT_TRUE(std::holds_alternative<ImageArea>(thesis.stimulusArea));
  EXPECT_EQ(ThresholdMapSettings{}.csf, "castlecsf");
  EXPECT_EQ(thesisOf({{"csf", textValue("daly98")}}).csf, "daly98");  // beside the preset
}

TEST(ThresholdModel, AdaptationLevelsFollowTheViewingDistance) {
  ThresholdMapSettings settings;
  settings.adaptation = NearestLevelAdaptation{};
  EXPECT_EQ(adaptationBlend(settings, 41.07, 7).level, 5);  // lg2 41.07 = 5.36
  EXPECT_EQ(adaptationBlend(settings, 46.0, 7).level, 6);   // 5.52
  EXPECT_EQ(adaptationBlend(settings, 0.1, 7).level, 0);
  EXPECT_EQ(adaptationBlend(settings, 4096.0, 7).level, 6);
  EXPECT_EQ(adaptationBlend(settings, 41.07, 1).level, 0);
  settings.adaptation = FractionalLevelAdaptation{};
  EXPECT_EQ(adaptationBlend(settings, 48.0, 7).level, 5);
  EXPECT_NEAR(adaptationBlend(settings, 48.0, 7).next, std::log2(48.0) - 5.0, 1e-12);
  EXPECT_EQ(adaptationBlend(settings, 0.5, 7).next, 0.0);
  settings.adaptation = GivenLevelAdaptation{3};
  EXPECT_EQ(adaptationBlend(settings, 41.07, 7).level, 3);
}

TEST(ThresholdModel, UnknownModelsAndDisplaysAreRefused) {
  ThresholdMapSettings settings;
  settings.csf = "bartem89";
  EXPECT_THROW(ThresholdModel(settings, 41.0, 64, 64), Error);
  EXPECT_THROW(ThresholdModel(ThresholdMapSettings{}, 0.0, 64, 64), Error);
}

TEST(ThresholdModel, TviOfACsfIsTheVisionModels) {
  for (const char* name : {"from_csf", "from_csf_scaled", "ward", "ward_smoothed"}) {
    const ThresholdModel thesis(thesisOf({{"tvi", textValue(name)}}), kStudyPpd, 64, 64),
        own(settingsOf({{"tvi", textValue(name)}}), kStudyPpd, 64, 64);
    CsfPoint point;
    point.areaDeg2 = 7.07;
    const auto thesisTvi = makeTvi(name, makeCsf("barten89"), CsfPoint{}),
               ownTvi = makeTvi(name, makeCsf("castlecsf"), point);
    for (const double luminance : {0.02, 0.9, 30.0, 100.0, 700.0}) {
      EXPECT_NEAR(thesis.tviCdM2(luminance) / thesisTvi(luminance), 1.0, 1e-8) << name << luminance;
      EXPECT_NEAR(own.tviCdM2(luminance) / ownTvi(luminance), 1.0, 1e-7) << name << luminance;
    }
  }
}

}  // namespace
}  // namespace limen::perception
