// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "experiments/base/error.h"
#include "perception/popping/predictor.h"
#include "perception/vision/csf_models.h"
#include "tests/perception/popping_gratings.h"

namespace limen::perception {
namespace {

// Section 17 of the specification: the study's display has 41.2 pixels per degree; the thesis names five
// contrast levels for it, the coarsest with a peak of at least 0.5 cpd; one pixel is about a degree at
// level 5.
TEST(PoppingModel, StudyDisplayHasFiveContrastLevels) {
  const PoppingModel model = poppingModel(1024, 768, studyDisplay(), thesisSettings());
  EXPECT_EQ(model.contrastLevels, 5);
  EXPECT_EQ(model.gaussianLevels, 7);
  EXPECT_EQ(model.adaptationLevel, 5);
  EXPECT_GE(model.peakCpd.back(), 0.5);
  // Peaks of the binomial pyramid with its transposed kernel upsampling, in cycles per pixel, and gains.
  const double cyclesPerPx[] = {0.49705, 0.11584, 0.05554, 0.02751, 0.01372},
               gain[] = {1, .689, .646, .637, .634};
  for (size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(model.peakCpd[i], cyclesPerPx[i] * model.pixelsPerDegree, 0.02 * model.peakCpd[i]);
    EXPECT_NEAR(model.gain[i], gain[i], 1e-3);
  }
  // 20.0 or 20.1 in: 452 deg2 (24.46 x 18.47).
  EXPECT_NEAR(poppingModel(1024, 768, studyDisplay(), thesisSettings()).areaDeg2, 452.0, 5.0);
}

// Thresholds 0.5, 1.0, 1.2 % are peak sensitivities 200, 100, 83.33; peaks at 0.15 deg/s are 245.44 (D98, 100
// cd/m2) and 32.458 (K83, 35 cd/m2): factors 0.81488, 3.0809, 2.5674.
TEST(PoppingModel, CalibrationMatchesTheThresholds) {
  const PoppingModel model = poppingModel(1024, 768, studyDisplay(), thesisSettings());
  EXPECT_NEAR(model.scaleA, 0.81488, 1e-5);
  EXPECT_NEAR(model.scaleRg, 3.0809, 1e-4);
  EXPECT_NEAR(model.scaleBy, 2.5674, 1e-4);
}

TEST(PoppingModel, LevelsFollowTheDisplayAndTheImage) {
  DisplayProfile display = studyDisplay();
  const PoppingModel near = poppingModel(1024, 768, display, thesisSettings());
  display.distanceM *= 2.0;
  // Twice the distance: twice the frequency everywhere, so one octave more fits above 0.5 cpd.
  const PoppingModel far = poppingModel(1024, 768, display, thesisSettings());
  for (size_t i = 0; i < 5; ++i) EXPECT_NEAR(far.peakCpd[i], 2.0 * near.peakCpd[i], 1e-12 * far.peakCpd[i]);
  EXPECT_EQ(far.contrastLevels, 6);
  EXPECT_EQ(poppingModel(1024, 15, display, thesisSettings()).contrastLevels, 2);
  EXPECT_EQ(poppingModel(1024, 3, display, thesisSettings()).contrastLevels, 0);
  EXPECT_EQ(poppingModel(1, 1, display, thesisSettings()).contrastLevels, 0);
  PoppingSettings settings = thesisSettings();
  settings.bands.levels = LevelCount{4};
  EXPECT_EQ(poppingModel(1024, 768, display, settings).contrastLevels, 2);
}

PoppingSettings settingsFrom(const std::map<std::string, ParameterValue>& given) {
  return PoppingSettings::table().read(ParameterValues(PoppingSettings::table().parameters(), given));
}

TEST(Popping, PresetIsTheThesisPredictor) {
  const PoppingSettings preset = settingsFrom({{"model", "schwarz_2009"}});
  const auto& achromatic = std::get<AchromaticPeakScale>(preset.sensitivity.achromatic.scale);
  EXPECT_EQ(preset.sensitivity.achromatic.csf.name, "daly98");
  EXPECT_EQ(achromatic.threshold, 0.005);
  EXPECT_EQ(achromatic.luminanceCdM2, 100.0);
  EXPECT_EQ(preset.sensitivity.redGreen.csf.name, "kelly83");
  EXPECT_EQ(preset.sensitivity.blueYellow.csf.name, "kelly83");
  EXPECT_EQ(std::get<ChromaticPeakScale>(preset.sensitivity.redGreen.scale).threshold, 0.010);
  EXPECT_EQ(std::get<ChromaticPeakScale>(preset.sensitivity.blueYellow.scale).threshold, 0.012);
  EXPECT_EQ(std::get<ChromaticPeakScale>(preset.sensitivity.blueYellow.scale).luminanceCdM2, 35.0);
  EXPECT_TRUE(std::holds_alternative<ConeContrast>(preset.sensitivity.contrast));
  EXPECT_TRUE(std::holds_alternative<ImageArea>(preset.sensitivity.stimulusArea));
  EXPECT_EQ(preset.regions.thresholdJnd, 2.0);
  EXPECT_EQ(preset.minkowskiExponent, 2.4);
  EXPECT_EQ(preset.rating.scale, 0.375);
  EXPECT_EQ(preset.rating.base, 2.25);
  EXPECT_EQ(preset.regions.connectivity, 8);
  EXPECT_EQ(preset.eyeModel(), EyeMovement::Monotone);
  EXPECT_EQ(preset.bands.peakModel, PeakModel::WithUpsample);
  EXPECT_EQ(std::get<LevelsByPeak>(preset.bands.levels).leastPeakCpd, 0.5);
  EXPECT_TRUE(std::get<PeakWeights>(preset.bands.weights).compensateGain);
}

// A preset changes defaults only: what is given, even the other preset's value, stays.
TEST(Popping, SettingsBesideAPresetAreKept) {
  const PoppingSettings mixed =
      settingsFrom({{"model", "schwarz_2009"}, {"sensitivity.achromatic.csf", "castlecsf"}});
  EXPECT_EQ(mixed.model, PredictorModel::Schwarz2009);
  EXPECT_EQ(mixed.sensitivity.achromatic.csf.name, "castlecsf");
  EXPECT_EQ(mixed.sensitivity.redGreen.csf.name, "kelly83");
  EXPECT_EQ(PoppingSettings::table().write(settingsFrom({})),
            PoppingSettings::table().write(PoppingSettings{}));
  EXPECT_EQ(PoppingSettings::table().write(settingsFrom({{"model", "schwarz_2009"}})),
            PoppingSettings::table().write(thesisSettings()));
}

TEST(Popping, SettingsAreReadAsWritten) {
  PoppingSettings settings;
  settings.eyeMovement = LiteralTracking{};
  settings.bands.peakModel = PeakModel::Halving;
  settings.bands.decomposition = PyramidBands{PyramidUpsampler::Linear};
  settings.adaptation = FixedAdaptation{50.0};
  settings.collapse = Collapse::Magnitude;
  settings.regions.connectivity = 4;
  settings.sensitivity.stimulusArea = FixedArea{100.0};
  const PoppingSettings read = settingsFrom(PoppingSettings::table().write(settings));
  EXPECT_EQ(read.eyeModel(), EyeMovement::Literal);
  EXPECT_EQ(read.bands.peakModel, PeakModel::Halving);
  EXPECT_EQ(read.bands.upsampler(), Upsampler::Successive);
  EXPECT_EQ(std::get<FixedAdaptation>(read.adaptation).luminanceCdM2, 50.0);
  EXPECT_EQ(read.collapse, Collapse::Magnitude);
  EXPECT_EQ(read.regions.connectivity, 4);
  EXPECT_EQ(std::get<FixedArea>(read.sensitivity.stimulusArea).deg2, 100.0);
  EXPECT_EQ(PoppingSettings::table().write(read), PoppingSettings::table().write(settings));
}

TEST(Popping, WhatMeansNothingCannotBeWritten) {
  EXPECT_THROW(settingsFrom({{"adaptation.luminance_cd_m2", 50.0}}), Error);
  EXPECT_THROW(settingsFrom({{"eye_movement", "none"}, {"eye_movement.least_velocity_deg_s", 0.1}}), Error);
  EXPECT_THROW(settingsFrom({{"flicker", "ignored"}, {"flicker.weight", 0.1}}), Error);
  EXPECT_THROW(settingsFrom({{"sensitivity.achromatic.scale", "absolute"},
                             {"sensitivity.achromatic.scale.threshold", 0.01}}),
               Error);
  EXPECT_THROW(settingsFrom({{"sensitivity.red_green.csf", "martin92_rg"},
                             {"sensitivity.red_green.csf.reference_cd_m2", 30.0}}),
               Error);
}

TEST(Popping, NoLevelHasMoreThanSixteenParameters) {
  const std::function<void(const std::vector<Parameter>&)> visit = [&](const std::vector<Parameter>& level) {
    EXPECT_LE(level.size(), 16U);
    for (const Parameter& parameter : level)
      for (const Alternative& alternative : parameter.alternatives) visit(alternative.parameters);
  };
  visit(PoppingSettings::table().parameters());
}

}  // namespace
}  // namespace limen::perception
