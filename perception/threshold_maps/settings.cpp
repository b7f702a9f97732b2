// SPDX-License-Identifier: BSD-3-Clause
#include "perception/threshold_maps/settings.h"

#include "perception/vision/csf.h"
#include "perception/vision/tvi.h"

namespace limen::perception {
namespace {

constexpr const char* kMap = "Schwarz 2009, section 9.4";
constexpr const char* kOriginal = "Ramasubramanian et al. 1999; Schwarz 2009, section 9.2";
constexpr const char* kFootnote = "Schwarz 2009, section 9.2, footnote";

std::vector<std::string> achromaticCsfs() {
  return {"barten89", "barten89_size",   "barten03", "martin92", "daly93",   "kelly79",
          "daly98",   "burbeck_kelly80", "laird06",  "stelacsf", "castlecsf"};
}
std::map<std::string, ParameterValue> presetValues(const std::string& choice) {
  return ThresholdMapSettings::table().write(ThresholdMapSettings::preset(fromText<PredictorModel>(choice)));
}
std::vector<std::string> maskings() { return {"none", "daly", "lubin", "self", "schwarz"}; }

}  // namespace

const SettingsTable<UpsampledStack>& UpsampledStack::table() {
  static const SettingsTable<UpsampledStack> kTable = {
      Binding(&UpsampledStack::upsampler, "upsampler",
              "how levels are upsampled: bilinearly, or with the kernel (reference only)", kMap)
          .formerly({"upsampler"})};
  return kTable;
}

const SettingsTable<GivenSigma>& GivenSigma::table() {
  static const SettingsTable<GivenSigma> kTable = {Binding(&GivenSigma::px, "px", Range{1e-3, 16.0}, "px",
                                                           "sigma of level 1", "Schwarz 2009, section 9.1.3")
                                                       .formerly({"stack_sigma_px"})};
  return kTable;
}

const SettingsTable<TrueStack>& TrueStack::table() {
  static const SettingsTable<TrueStack> kTable = {
      {&TrueStack::sigma, "sigma", "sigma of level 1", "Schwarz 2009, section 9.1.3"}};
  return kTable;
}

const SettingsTable<BurtKernel>& BurtKernel::table() {
  static const SettingsTable<BurtKernel> kTable = {Binding(&BurtKernel::centre, "centre", Range{0.25, 0.6},
                                                           "", "centre weight; 0.375 is the binomial",
                                                           "Burt and Adelson 1983")
                                                       .formerly({"burt_a"})};
  return kTable;
}

const SettingsTable<GivenLevelAdaptation>& GivenLevelAdaptation::table() {
  static const SettingsTable<GivenLevelAdaptation> kTable = {
      Binding(&GivenLevelAdaptation::level, "level", Range{0, 8}, "",
              "level of the Gaussian pyramid; 0: every pixel its own", kMap)
          .formerly({"adaptation_level"})};
  return kTable;
}

const SettingsTable<NoLowElevation>& NoLowElevation::table() {
  static const SettingsTable<NoLowElevation> kTable = {
      Binding(&NoLowElevation::belowCpd, "below_cpd", Range{0.0, 60.0}, "cpd",
              "frequency below which there is no elevation", kFootnote)
          .formerly({"f_low_cpd"})};
  return kTable;
}

const SettingsTable<ActualElevation>& ActualElevation::table() {
  static const SettingsTable<ActualElevation> kTable = {
      Binding(&ActualElevation::low, "low", "elevation at low frequencies", kFootnote).formerly({"f_low"})};
  return kTable;
}

const SettingsTable<OriginalElevation>& OriginalElevation::table() {
  using S = OriginalElevation;
  static const SettingsTable<S> kTable = {
      Binding(&S::luminanceCdM2, "luminance_cd_m2", Range{1e-4, 1e5}, "cd/m2",
              "luminance at which it is evaluated", "Schwarz 2009, (9.11)")
          .formerly({"f_luminance_cd_m2"}),
      Binding(&S::low, "low", "elevation at low frequencies", kFootnote).formerly({"f_low"})};
  return kTable;
}

const SettingsTable<SmoothFlat>& SmoothFlat::table() {
  static const SettingsTable<SmoothFlat> kTable = {
      Binding(&SmoothFlat::epsilon, "epsilon", Range{1e-12, 0.1}, "",
              "added contrast; a fiftieth of the visibility threshold")
          .formerly({"flat_epsilon"})};
  return kTable;
}

const SettingsTable<ThresholdMapSettings>& ThresholdMapSettings::table() {
  using S = ThresholdMapSettings;
  static const SettingsTable<S> kTable = {
      Binding(&S::model, "model",
              "sets the defaults of all other settings: castleCSF, or the thesis's choices",
              "Ashraf et al. 2024; Schwarz 2009, section 9.4")
          .presets(&presetValues)
          .formerly({"map"}),
      {&S::levels, "levels", {3, 9}, "", "levels of the Gaussian pyramid; two fewer contrast levels", kMap},
      {&S::decomposition, "decomposition", "source of the frequency bands", kMap},
      Binding(&S::downsample, "downsample",
              "the 5x5 kernel that precedes halving, which the thesis does not name", kMap)
          .formerly({"kernel"}),
      {&S::border, "border", "extension beyond the image's edge"},
      {&S::peakModel, "peak_model", "assumed peak frequencies of the bands; halving is wrong, for comparison",
       "Schwarz 2009, section 10.3"},
      {&S::gainCompensation, "gain_compensation", "divide each band by its peak gain",
       "Schwarz 2009, section 10.3"},
      {&S::adaptation, "adaptation", "adaptation luminance", kMap},
      {&S::csf, "csf", Names{achromaticCsfs()}, "contrast sensitivity function", kOriginal},
      {&S::stimulusArea, "stimulus_area", "area of the stimulus in sensitivities that depend on it"},
      {&S::masking, "masking", Names{maskings()}, "threshold elevation by contrast; none switches it off",
       kOriginal},
      {&S::tvi, "tvi", Names{tviNames()}, "threshold versus intensity", kOriginal},
      Binding(&S::frequencyElevation, "frequency_elevation", "threshold elevation by frequency",
              "Schwarz 2009, (9.11) and section 9.4")
          .formerly({"f_rule"}),
      {&S::tviFactor,
       "tvi_factor",
       {0.0, 10.0},
       "",
       "share of the TVI used as threshold",
       "Schwarz 2009, section 9.2"},
      Binding(&S::flat, "flat", "elevation where there is no contrast").formerly({"flat_rule"}),
      {&S::contrastEpsilonCdM2,
       "contrast_epsilon_cd_m2",
       {1e-9, 10.0},
       "cd/m2",
       "smallest denominator of a contrast; smaller ones are counted"},
      {&S::largestCdM2,
       "largest_cd_m2",
       {1.0, 1e6},
       "cd/m2",
       "brighter pixels count as this; above 6e4 16-bit results overflow"}};
  return kTable;
}

ThresholdMapSettings ThresholdMapSettings::preset(PredictorModel model) {
  ThresholdMapSettings out;
  out.model = model;
  if (model == PredictorModel::Limen2026) return out;
  out.csf = "barten89";
  out.stimulusArea = ImageArea{};
  return out;
}

Kernel ThresholdMapSettings::kernel() const {
  if (nineFetch()) return Kernel::nineFetch6();
  const auto* burt = std::get_if<BurtKernel>(&downsample);
  return burt ? Kernel::burt6(burt->centre) : Kernel::fused6();
}

PyramidSettings ThresholdMapSettings::pyramid() const {
  const Upsampler successive = expands() ? Upsampler::Expand : Upsampler::Successive;
  return {levels, kernel(), isPyramid() ? Upsampler::Bilinear : successive, border};
}

bool ThresholdMapSettings::expands() const {
  const auto* stack = std::get_if<UpsampledStack>(&decomposition);
  return stack && stack->upsampler == StackUpsampler::Expand;
}

double ThresholdMapSettings::stackSigmaPx() const {
  const auto* stack = std::get_if<TrueStack>(&decomposition);
  const auto* given = stack ? std::get_if<GivenSigma>(&stack->sigma) : nullptr;
  return given ? given->px : 0.0;
}

const SettingsTable<GivenLevels>& GivenLevels::table() {
  static const SettingsTable<GivenLevels> kTable = {
      Binding(&GivenLevels::count, "count", Range{1, 3}, "", "levels").formerly({"levels_per_pass"})};
  return kTable;
}

const SettingsTable<ThresholdMapGpuSettings>& ThresholdMapGpuSettings::table() {
  using S = ThresholdMapGpuSettings;
  static const SettingsTable<S> kTable = {
      Binding(&S::precision, "precision", oneOf({16, 32}), "bit", "bits of intermediate results", kMap)
          .formerly({"gpu"}),
      {&S::lookup, "lookup",
       "CSF and TVI from tables over luminance, or computed for every pixel (barten89 and ward only)", kMap},
      {&S::levelsPerPass, "levels_per_pass",
       "pyramid levels computed per pass from level 1; affects only speed"},
      {&S::finest, "finest",
       "what is stored of level 0 in 32 bits at even sizes: the finest band, or luminance; affects only "
       "speed"}};
  return kTable;
}

}  // namespace limen::perception
