// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <variant>

#include "experiments/base/settings_table.h"
#include "perception/multiscale/band_peaks.h"
#include "perception/vision/predictor_model.h"
#include "perception/vision/stimulus_area.h"

/// Settings of the single threshold map: for each pixel of one image a luminance increment at threshold, the
/// same for all frequencies. Kept as published, for comparison; thresholds that hold by the predictor are
/// those of perception/band_thresholds. Sources: Ramasubramanian et al. 1999; Schwarz 2009, sections 9.2
/// and 9.4.
namespace limen::perception {

/// How a stack upsamples levels.
enum class StackUpsampler {
  Bilinear,
  Expand  ///< with the kernel; CPU only
};
constexpr EnumNames<StackUpsampler, 2> enumNames(StackUpsampler) {
  return {{{{StackUpsampler::Bilinear, "bilinear"}, {StackUpsampler::Expand, "expand"}}}};
}

// Where bands come from.
struct UpsampledStack {
  static constexpr const char *kKind = "stack",
                              *kSummary = "pyramid whose levels are upsampled one level at a time";
  StackUpsampler upsampler = StackUpsampler::Bilinear;
  static const SettingsTable<UpsampledStack>& table();
};
struct SampledPyramid {
  static constexpr const char *kKind = "pyramid", *kSummary = "pyramid sampled directly: faster, blocky";
};

struct KernelSigma {
  static constexpr const char *kKind = "of_kernel", *kSummary = "that of the pyramid's kernel in the limit";
};
struct GivenSigma {
  static constexpr const char *kKind = "given", *kSummary = "a given one";
  double px = 1.0;
  static const SettingsTable<GivenSigma>& table();
};
struct TrueStack {
  static constexpr const char
      *kKind = "true_stack",
      *kSummary = "Gaussians of doubling sigma at full resolution, which the others approximate (CPU only)";
  std::variant<KernelSigma, GivenSigma> sigma;  ///< of level 1
  static const SettingsTable<TrueStack>& table();
};
struct RepeatedStack {
  static constexpr const char *kKind = "repeated",
                              *kSummary =
                                  "one small kernel again and again, a published mistake "
                                  "(section 9.6; CPU only)";
};

// The 5x5 kernel before the bilinear step of halving, which the thesis does not name.
struct BinomialKernel {
  static constexpr const char *kKind = "binomial", *kSummary = "binomial, as six taps per axis";
};
struct NineFetchKernel {
  static constexpr const char *kKind = "nine_fetch",
                              *kSummary =
                                  "binomial, as the thesis's nine bilinear fetches, which equal the "
                                  "six taps for even sizes only";
};
struct BurtKernel {
  static constexpr const char *kKind = "burt", *kSummary = "Burt and Adelson's five taps";
  double centre = 0.4;  ///< weight in the middle; 0.375: binomial
  static const SettingsTable<BurtKernel>& table();
};

// Adaptation luminance.
struct OneDegreeAdaptation {
  static constexpr const char *kKind = "one_degree",
                              *kSummary = "mean over one degree: the two levels that enclose it, blended";
};
struct NearestLevelAdaptation {
  static constexpr const char *kKind = "nearest_level", *kSummary = "level round(lg2 ppd)";
};
struct FractionalLevelAdaptation {
  static constexpr const char *kKind = "fractional_level", *kSummary = "levels around lg2 ppd, blended";
};
struct GivenLevelAdaptation {
  static constexpr const char *kKind = "level", *kSummary = "a given level";
  int level = 5;  ///< 0: each pixel adapts to itself
  static const SettingsTable<GivenLevelAdaptation>& table();
};
struct MistakenDegreeAdaptation {
  static constexpr const char *kKind = "mistaken_degree",
                              *kSummary =
                                  "the image's degrees mistaken for the pixels to average, a published "
                                  "mistake (section 9.6; CPU only)";
};

// Elevation of the threshold at low frequencies.
struct NoLowElevation {
  static constexpr const char *kKind = "one", *kSummary = "none";
  double belowCpd = 4.0;
  static const SettingsTable<NoLowElevation>& table();
};
struct ComputedLowElevation {
  static constexpr const char *kKind = "as_computed", *kSummary = "as at all others";
};

// Elevation of the threshold by frequency.
struct ActualElevation {
  static constexpr const char *kKind = "actual", *kSummary = "at the adaptation luminance";
  std::variant<ComputedLowElevation, NoLowElevation> low;
  static const SettingsTable<ActualElevation>& table();
};
struct OriginalElevation {
  static constexpr const char *kKind = "original", *kSummary = "at one luminance";
  double luminanceCdM2 = 100.0;
  std::variant<NoLowElevation, ComputedLowElevation> low;
  static const SettingsTable<OriginalElevation>& table();
};
struct NoFrequencyElevation {
  static constexpr const char *kKind = "none", *kSummary = "none";
};

// Elevation where there is no contrast.
struct SmoothFlat {
  static constexpr const char *kKind = "smooth", *kSummary = "(sum + epsilon) / (sum + epsilon), at least 1";
  double epsilon = 1e-4;
  static const SettingsTable<SmoothFlat>& table();
};
struct ExactFlat {
  static constexpr const char *kKind = "exact", *kSummary = "1 where the sum is exactly 0";
};

/// The model, shared by reference and GPU.
struct ThresholdMapSettings {
  static constexpr const char *kKind = "single",
                              *kSummary =
                                  "one threshold for all frequencies; differences below it may be visible";
  /// Names the choices made in all other members.
  PredictorModel model = PredictorModel::Limen2026;
  int levels = 7;
  std::variant<UpsampledStack, SampledPyramid, TrueStack, RepeatedStack> decomposition;
  std::variant<BinomialKernel, NineFetchKernel, BurtKernel> downsample;
  Border border = Border::Clamp;
  PeakModel peakModel = PeakModel::NoUpsample;
  bool gainCompensation = false;
  std::variant<OneDegreeAdaptation, NearestLevelAdaptation, FractionalLevelAdaptation, GivenLevelAdaptation,
               MistakenDegreeAdaptation>
      adaptation;
  std::string csf = "castlecsf", masking = "daly", tvi = "ward";
  /// Of CSFs that depend on it.
  std::variant<FixedArea, ImageArea> stimulusArea;
  std::variant<ActualElevation, OriginalElevation, NoFrequencyElevation> frequencyElevation;
  double tviFactor = 0.2;
  std::variant<SmoothFlat, ExactFlat> flat;
  double contrastEpsilonCdM2 = 1e-4;
  double largestCdM2 = 6e4;
  static const SettingsTable<ThresholdMapSettings>& table();
  /// The settings that a model stands for. Limen2026: those of ThresholdMapSettings{}.
  static ThresholdMapSettings preset(PredictorModel model);

  /// Five taps and how they are applied.
  Kernel kernel() const;
  PyramidSettings pyramid() const;
  bool nineFetch() const { return std::holds_alternative<NineFetchKernel>(downsample); }
  bool isTrueStack() const { return std::holds_alternative<TrueStack>(decomposition); }
  bool isPyramid() const { return std::holds_alternative<SampledPyramid>(decomposition); }
  /// Levels are upsampled with the kernel.
  bool expands() const;
  /// Of level 1 of a true stack; 0: that of the kernel.
  double stackSigmaPx() const;
};

enum class ThresholdLookup {
  Tables,  ///< CSF and TVI from tables over luminance
  Direct   ///< computed for every pixel
};
constexpr EnumNames<ThresholdLookup, 2> enumNames(ThresholdLookup) {
  return {{{{ThresholdLookup::Tables, "tables"}, {ThresholdLookup::Direct, "direct"}}}};
}

/// What is stored of level 0. In 16 bits, by nine fetches and at odd sizes this makes no difference.
enum class FinestStored {
  Band,      ///< what it has more than level 1
  Luminance  ///< itself, and of level 1 what its rounding took away; quicker to make, as exact
};
constexpr EnumNames<FinestStored, 2> enumNames(FinestStored) {
  return {{{{FinestStored::Band, "band"}, {FinestStored::Luminance, "luminance"}}}};
}

// Pyramid levels computed per pass, from level 1.
struct AutomaticLevels {
  static constexpr const char *kKind = "automatic", *kSummary = "one for large levels, three for small ones";
};
struct GivenLevels {
  static constexpr const char *kKind = "given", *kSummary = "a given number";
  int count = 1;
  static const SettingsTable<GivenLevels>& table();
};

/// How the GPU computes them.
struct ThresholdMapGpuSettings {
  int precision = 32;  ///< bits of intermediate results
  ThresholdLookup lookup = ThresholdLookup::Tables;
  std::variant<AutomaticLevels, GivenLevels> levelsPerPass = {};
  FinestStored finest = FinestStored::Luminance;
  static const SettingsTable<ThresholdMapGpuSettings>& table();

  bool half() const { return precision == 16; }
  bool direct() const { return lookup == ThresholdLookup::Direct; }
};

}  // namespace limen::perception
