// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "experiments/base/chosen_entry.h"
#include "experiments/base/settings_table.h"
#include "perception/multiscale/band_peaks.h"
#include "perception/popping/detection.h"
#include "perception/popping/neighbourhood.h"
#include "perception/popping/temporal_settings.h"
#include "perception/popping/weight_settings.h"
#include "perception/vision/eye_movement.h"
#include "perception/vision/predictor_model.h"
#include "perception/vision/stimulus_area.h"

/// Settings of the popping predictor. Schwarz 2009, sections 10.3.3 and 10.3.4.
namespace limen::perception {

// Scale of a channel's sensitivity.
struct AbsoluteScale {
  static constexpr const char *kKind = "absolute",
                              *kSummary = "as the model states it, 1 / the contrast at threshold";
};
/// The model's shape, with its peak brought to 1 / `threshold`.
struct AchromaticPeakScale {
  static constexpr const char *kKind = "peak", *kSummary = "its peak is brought to 1 / threshold";
  double threshold = 0.005;      ///< contrast threshold at the peak of sensitivity
  double luminanceCdM2 = 100.0;  ///< adaptation luminance to which the threshold refers
  double velocityDegS = 0.15;    ///< retinal velocity to which it refers
  static const SettingsTable<AchromaticPeakScale>& table();
};
struct ChromaticPeakScale {
  static constexpr const char *kKind = AchromaticPeakScale::kKind, *kSummary = AchromaticPeakScale::kSummary;
  double threshold = 0.010;
  double luminanceCdM2 = 35.0;
  double velocityDegS = 0.15;
  static const SettingsTable<ChromaticPeakScale>& table();
};

/// Sensitivity of channel A.
struct AchromaticSettings {
  ChosenEntry csf{"castlecsf", {}};  ///< of CsfRegistry
  std::variant<AbsoluteScale, AchromaticPeakScale> scale;
  static const SettingsTable<AchromaticSettings>& table();
};
/// Of channel a or b; RG or YV.
struct ChromaticSettings {
  ChosenEntry csf{"castlecsf_rg", {}};  ///< of CsfRegistry, with Kelly83Scale for kelly83
  std::variant<AbsoluteScale, ChromaticPeakScale> scale;
  static const SettingsTable<ChromaticSettings>& table();
};
/// How a predictor scales Kelly 1983 with luminance.
struct Kelly83Scale {
  double referenceCdM2 = 35.0;  ///< luminance of the data, at which the scale is 1
  static const SettingsTable<Kelly83Scale>& table();
  /// Those of a CSF chosen for a chromatic channel.
  static Kelly83Scale of(const ChosenEntry& csf);
};

// What contrasts are taken of.
struct DklContrast {
  static constexpr const char *kKind = "dkl",
                              *kSummary = "A, RG and YV of DKL space adapted to D65, each over the local A";
};
struct ConeContrast {
  static constexpr const char *kKind = "cones",
                              *kSummary = "each cone over its own local response, then Hunt's opponents";
  bool divideGreyGain = true;  ///< divide A by 3.05, so that it is luminance contrast
  static const SettingsTable<ConeContrast>& table();
};

struct SensitivitySettings {
  AchromaticSettings achromatic;
  ChromaticSettings redGreen, blueYellow{.csf = {"castlecsf_yv", {}}, .scale = {}};
  std::variant<DklContrast, ConeContrast> contrast;
  /// Of CSFs that depend on it. 7.07 deg2: a Gabor patch of sigma 1.5 degrees, about which ColorVideoVDP
  /// reads castleCSF.
  std::variant<FixedArea, ImageArea> stimulusArea;
  static const SettingsTable<SensitivitySettings>& table();

  bool isDkl() const { return std::holds_alternative<DklContrast>(contrast); }
  /// Channel A of a grey contrast of 1: 1 unless cones are weighted as Hunt does without division by 3.05.
  double greyGain() const;
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

// What a level's contrast is multiplied by.
struct FittedWeights {
  static constexpr const char
      *kKind = "fitted",
      *kSummary =
          "three parts of each level, weighted such that gratings at threshold have 1 JND "
          "whatever their frequency";
};
struct PeakWeights {
  static constexpr const char *kKind = "peak", *kSummary = "the sensitivity at the level's peak";
  bool compensateGain = true;  ///< divide a level's contrast by its filter's gain
  static const SettingsTable<PeakWeights>& table();
};

struct BandSettings {
  std::variant<PyramidBands, StackBands> decomposition;
  std::variant<LevelsByPeak, LevelCount> levels;
  std::variant<PeakWeights, FittedWeights> weights;  ///< see band_weights.h
  double kernelCentre = 0.375;  ///< a of the low-pass 1/4 - a/2, 1/4, a, 1/4, 1/4 - a/2; 0.375: binomial
  PeakModel peakModel = PeakModel::WithUpsample;
  double denominatorEpsilon = 1e-3;  ///< smallest cone response used as a contrast's denominator [cd/m2]
  static const SettingsTable<BandSettings>& table();

  Kernel kernel() const { return Kernel::burt5(kernelCentre); }
  bool isStack() const { return std::holds_alternative<StackBands>(decomposition); }
  bool isFitted() const { return std::holds_alternative<FittedWeights>(weights); }
  /// Whether a level's contrast is divided by its filter's gain, or shown as if it were.
  bool compensatesGain() const;
  void check() const;  ///< Throws Error for weights that are not known for a stack.
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
  /// Names the choices made in all other members.
  PredictorModel model = PredictorModel::Limen2026;
  SensitivitySettings sensitivity;
  std::variant<MonotoneTracking, FlooredTracking, LiteralTracking, NoTracking> eyeMovement;
  std::variant<TemporalChannels, SingleFrame> temporal;  ///< of switches
  ChosenEntry masking{"schwarz", {}};                    ///< of MaskingRegistry
  std::variant<NoNeighbours, ExtendedMasking> neighbourhood;
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
  /// The settings that a model stands for. Limen2026: those of PoppingSettings{}.
  static PoppingSettings preset(PredictorModel model);

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
