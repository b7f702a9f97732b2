// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "experiments/base/chosen_entry.h"
#include "experiments/base/settings_table.h"
#include "perception/multiscale/band_peaks.h"
#include "perception/popping/detection.h"
#include "perception/popping/temporal_settings.h"
#include "perception/popping/weight_settings.h"
#include "perception/vision/eye_movement.h"

/// Settings of the popping predictor. Schwarz 2009, sections 10.3.3 and 10.3.4.
namespace limen::perception {

/// Sensitivity of channel A.
struct AchromaticSettings {
  ChosenEntry csf{"daly98", {}};  ///< of CsfRegistry
  double threshold = 0.005;       ///< contrast threshold at the peak of sensitivity
  double luminanceCdM2 = 100.0;   ///< adaptation luminance to which the threshold refers
  static const SettingsTable<AchromaticSettings>& table();
};
/// Of channel a or b.
struct ChromaticSettings {
  ChosenEntry csf{"kelly83", {}};  ///< of CsfRegistry, with Kelly83Scale for kelly83
  double threshold = 0.010;
  double luminanceCdM2 = 35.0;
  static const SettingsTable<ChromaticSettings>& table();
};
/// How a predictor scales Kelly 1983 with luminance.
struct Kelly83Scale {
  double referenceCdM2 = 35.0;  ///< luminance of the data, at which the scale is 1
  static const SettingsTable<Kelly83Scale>& table();
  /// Those of a CSF chosen for a chromatic channel.
  static Kelly83Scale of(const ChosenEntry& csf);
};

struct ImageArea {
  static constexpr const char *kKind = "image", *kSummary = "that of the images on the display";
};
struct FixedArea {
  static constexpr const char *kKind = "fixed", *kSummary = "a given one";
  double deg2 = 187.0;
  static const SettingsTable<FixedArea>& table();
};

struct SensitivitySettings {
  AchromaticSettings achromatic;
  ChromaticSettings redGreen, blueYellow{.threshold = 0.012};
  double velocityDegS = 0.15;                       ///< retinal velocity to which the thresholds refer
  std::variant<ImageArea, FixedArea> stimulusArea;  ///< of Barten's CSF
  bool divideGreyGain = true;                       ///< divide A by 3.05, so that it is luminance contrast
  static const SettingsTable<SensitivitySettings>& table();
};

// Retinal velocity that remains after the eye's tracking; see EyeMovement.
struct LiteralTracking {
  static constexpr const char *kKind = "literal", *kSummary = "as published, vanishing at 0.833 deg/s";
};
struct FlooredTracking {
  static constexpr const char *kKind = "floor",
                              *kSummary = "as published, but never below the drift velocity";
  double leastVelocityDegS = kLeastRetinalVelocityDegS;  ///< drift velocity
  static const SettingsTable<FlooredTracking>& table();
};
struct MonotoneTracking {
  static constexpr const char *kKind = "monotone",
                              *kSummary = "growing with speed, and never below the drift velocity";
  double leastVelocityDegS = kLeastRetinalVelocityDegS;
  static const SettingsTable<MonotoneTracking>& table();
};
struct NoTracking {
  static constexpr const char *kKind = "none", *kSummary = "the screen velocity";
};

/// Number of levels.
struct LevelsByPeak {
  static constexpr const char *kKind = "by_peak", *kSummary = "all contrast levels whose peak is fine enough";
  double leastPeakCpd = 0.5;  ///< of the coarsest contrast level
  static const SettingsTable<LevelsByPeak>& table();
};
struct LevelCount {
  static constexpr const char *kKind = "count", *kSummary = "a given number";
  int gaussian = 7;  ///< levels of the Gaussian pyramid, two more than of contrast
  static const SettingsTable<LevelCount>& table();
};

/// Upsamplers of a cosited pyramid.
enum class PyramidUpsampler { Linear, Expand };
constexpr EnumNames<PyramidUpsampler, 2> enumNames(PyramidUpsampler) {
  return {{{{PyramidUpsampler::Linear, "linear"}, {PyramidUpsampler::Expand, "expand"}}}};
}

/// Where bands come from.
struct PyramidBands {
  static constexpr const char *kKind = "pyramid", *kSummary = "halved level by level, as the thesis does";
  PyramidUpsampler upsampler = PyramidUpsampler::Expand;
  static const SettingsTable<PyramidBands>& table();
};
struct StackBands {
  static constexpr const char *kKind = "stack",
                              *kSummary =
                                  "every level at full size, which the pyramid approximates; on the "
                                  "CPU only";
};

struct BandSettings {
  std::variant<PyramidBands, StackBands> decomposition;
  std::variant<LevelsByPeak, LevelCount> levels;
  double kernelCentre = 0.375;  ///< a of the low-pass 1/4 - a/2, 1/4, a, 1/4, 1/4 - a/2; 0.375: binomial
  PeakModel peakModel = PeakModel::WithUpsample;
  bool compensateGain = true;        ///< divide a level's contrast by its filter's gain
  double denominatorEpsilon = 1e-3;  ///< smallest cone response used as a contrast's denominator [cd/m2]
  static const SettingsTable<BandSettings>& table();

  Kernel kernel() const { return Kernel::burt5(kernelCentre); }
  bool isStack() const { return std::holds_alternative<StackBands>(decomposition); }
  /// Of coarser levels: Expand or Successive (linear). A stack upsamples nothing.
  Upsampler upsampler() const;
};

// Luminance to which the eye is adapted.
struct LocalAdaptation {
  static constexpr const char *kKind = "local",
                              *kSummary = "of the level whose pixels are closest to one degree";
};
struct MeanAdaptation {
  static constexpr const char *kKind = "mean", *kSummary = "mean of the frame";
};
struct FixedAdaptation {
  static constexpr const char *kKind = "fixed", *kSummary = "a given luminance";
  double luminanceCdM2 = 100.0;
  static const SettingsTable<FixedAdaptation>& table();
};
struct LevelAdaptation {
  static constexpr const char *kKind = "level", *kSummary = "of a given level";
  int level = 5;  ///< of the Gaussian pyramid
  static const SettingsTable<LevelAdaptation>& table();
};

/// How a coarse level's response difference reaches the pixels of the finest.
enum class Collapse {
  Signed,    ///< interpolated, then raised: as if every level had full size
  Magnitude  ///< raised, then interpolated
};
constexpr EnumNames<Collapse, 2> enumNames(Collapse) {
  return {{{{Collapse::Signed, "signed"}, {Collapse::Magnitude, "magnitude"}}}};
}

enum class SeedRule {
  ColourDiffers,  ///< a region needs a pixel where the input colours differ
  None
};
constexpr EnumNames<SeedRule, 2> enumNames(SeedRule) {
  return {{{{SeedRule::ColourDiffers, "colour_differs"}, {SeedRule::None, "none"}}}};
}

struct RegionSettings {
  double thresholdJnd = 2.0;  ///< inclusive
  int connectivity = 8;       ///< 4 or 8
  SeedRule seeds = SeedRule::ColourDiffers;
  static const SettingsTable<RegionSettings>& table();
};

/// R = ln(scale * Sigma) / ln(base).
struct RatingSettings {
  double scale = 0.375, base = 2.25;
  static const SettingsTable<RatingSettings>& table();
};

/// Every constant of the popping predictor.
struct PoppingSettings {
  SensitivitySettings sensitivity;
  std::variant<MonotoneTracking, FlooredTracking, LiteralTracking, NoTracking> eyeMovement;
  std::variant<TemporalChannels, SingleFrame> temporal;  ///< of switches
  ChosenEntry masking{"schwarz", {}};                    ///< of MaskingRegistry
  BandSettings bands;
  std::variant<LocalAdaptation, MeanAdaptation, FixedAdaptation, LevelAdaptation> adaptation;
  double minkowskiExponent = 2.4;
  Collapse collapse = Collapse::Signed;
  std::variant<DisocclusionSettings, IgnoredWeight> disocclusion;  ///< used if given
  std::variant<FlickerSettings, IgnoredWeight> flicker;            ///< used if given
  RegionSettings regions;
  RatingSettings rating;
  DetectionModel detection;
  static const SettingsTable<PoppingSettings>& table();

  EyeMovement eyeModel() const;
  /// Smallest retinal velocity, due to drift; the default's if the eye model has none.
  double leastVelocityDegS() const;
  bool usesDisocclusion() const { return std::holds_alternative<DisocclusionSettings>(disocclusion); }
  bool usesFlicker() const { return std::holds_alternative<FlickerSettings>(flicker); }
  /// Those of a predictor that ignores them are the defaults.
  DisocclusionSettings disocclusionSettings() const;
  FlickerSettings flickerSettings() const;
};

}  // namespace limen::perception
