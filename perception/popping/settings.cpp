// SPDX-License-Identifier: BSD-3-Clause
#include "perception/popping/settings.h"

#include <set>

#include "experiments/base/error.h"
#include "perception/vision/colour.h"
#include "perception/vision/csf.h"
#include "perception/vision/masking.h"

namespace limen::perception {
namespace {

constexpr const char *kModel = "Schwarz 2009, section 10.3.3", *kRegions = "Schwarz 2009, section 10.3.4",
                     *kOwn = "choice";

std::vector<std::string> chromaticCsfNames() {
  std::set<std::string> names;
  for (const Channel channel : {Channel::RedGreen, Channel::BlueYellow})
    for (const std::string& name : csfNames(channel)) names.insert(name);
  return {names.begin(), names.end()};
}

/// A CSF by name, with the registry's constants except for the scale of Kelly 1983.
template <class S>
Binding<S> csfChoice(std::vector<std::string> names, std::string description) {
  settings::EntryOptions options{
      std::move(names), [](const std::string& name) -> const std::vector<Parameter>& {
        static const std::vector<Parameter> kScale = Kelly83Scale::table().parameters(), kNone;
        return name == "kelly83" ? kScale : kNone;
      }};
  return {settings::state(ParameterType::Choice, "csf", std::move(description), kModel),
          std::make_shared<settings::EntryMember<S>>(&S::csf, std::move(options))};
}

constexpr Range kContrast{1e-5, 1.0}, kLuminance{1e-3, 1e4}, kDrift{1e-3, 10.0};
constexpr const char* kDriftText = "smallest retinal velocity, due to drift";
constexpr const char* kScaleText = "scale of the sensitivity";

template <class S>
SettingsTable<S> peakTable(std::vector<std::string> formerThresholds,
                           std::vector<std::string> formerLuminances) {
  return {Binding(&S::threshold, "threshold", kContrast, "contrast",
                  "contrast threshold at the peak of sensitivity", kModel)
              .formerly(std::move(formerThresholds)),
          Binding(&S::luminanceCdM2, "luminance_cd_m2", kLuminance, "cd/m2",
                  "adaptation luminance to which the threshold refers", kOwn)
              .formerly(std::move(formerLuminances)),
          Binding(&S::velocityDegS, "velocity_deg_s", Range{0.01, 100.0}, "deg/s",
                  "retinal velocity to which the threshold refers", kOwn)
              .formerly({"calibration_velocity_deg_s", "velocity_deg_s"})};
}

std::map<std::string, ParameterValue> presetValues(const std::string& choice) {
  return PoppingSettings::table().write(PoppingSettings::preset(fromText<PredictorModel>(choice)));
}

}  // namespace

const SettingsTable<AchromaticPeakScale>& AchromaticPeakScale::table() {
  static const SettingsTable<AchromaticPeakScale> kTable = peakTable<AchromaticPeakScale>(
      {"threshold_achromatic", "threshold"}, {"calibration_luminance_cd_m2", "luminance_cd_m2"});
  return kTable;
}

const SettingsTable<ChromaticPeakScale>& ChromaticPeakScale::table() {
  static const SettingsTable<ChromaticPeakScale> kTable =
      peakTable<ChromaticPeakScale>({"threshold_red_green", "threshold_blue_yellow", "threshold"},
                                    {"calibration_chromatic_cd_m2", "luminance_cd_m2"});
  return kTable;
}

const SettingsTable<AchromaticSettings>& AchromaticSettings::table() {
  using S = AchromaticSettings;
  static const SettingsTable<S> kTable = {
      csfChoice<S>(csfNames(Channel::Achromatic), "contrast sensitivity of the channel")
          .formerly({"csf_achromatic"}),
      {&S::scale, "scale", kScaleText, kOwn}};
  return kTable;
}

const SettingsTable<ChromaticSettings>& ChromaticSettings::table() {
  using S = ChromaticSettings;
  static const SettingsTable<S> kTable = {
      csfChoice<S>(chromaticCsfNames(), "contrast sensitivity of the channel")
          .formerly({"csf_red_green", "csf_blue_yellow"}),
      {&S::scale, "scale", kScaleText, kOwn}};
  return kTable;
}

const SettingsTable<Kelly83Scale>& Kelly83Scale::table() {
  static const SettingsTable<Kelly83Scale> kTable = {
      Binding(&Kelly83Scale::referenceCdM2, "reference_cd_m2", kLuminance, "cd/m2",
              "luminance of the sensitivity's data, at which the scale is 1", kModel)
          .formerly({"chromatic_reference_cd_m2"})};
  return kTable;
}

Kelly83Scale Kelly83Scale::of(const ChosenEntry& csf) {
  return csf.values.all().empty() ? Kelly83Scale{} : table().read(csf.values);
}

const SettingsTable<SensitivitySettings>& SensitivitySettings::table() {
  using S = SensitivitySettings;
  static const SettingsTable<S> kTable = {
      {&S::achromatic, "achromatic", "channel A, luminance contrast"},
      {&S::redGreen, "red_green", "channel a, or RG"},
      {&S::blueYellow, "blue_yellow", "channel b, or YV"},
      {&S::contrast, "contrast", "colour space of the contrasts", kModel},
      Binding(&S::stimulusArea, "stimulus_area", "area of the stimulus in sensitivities that depend on it",
              kModel)
          .formerly({"stimulus_area_deg2"})};
  return kTable;
}

const SettingsTable<ConeContrast>& ConeContrast::table() {
  static const SettingsTable<ConeContrast> kTable = {
      Binding(&ConeContrast::divideGreyGain, "divide_grey_gain",
              "divide A by 3.05, its value for a grey contrast of 1", kOwn)
          .formerly({"divide_grey_gain"})};
  return kTable;
}

double SensitivitySettings::greyGain() const {
  const auto* cones = std::get_if<ConeContrast>(&contrast);
  return cones && !cones->divideGreyGain ? opponentFromLms({1, 1, 1}).x : 1.0;
}

const SettingsTable<FlooredTracking>& FlooredTracking::table() {
  static const SettingsTable<FlooredTracking> kTable = {
      Binding(&FlooredTracking::leastVelocityDegS, "least_velocity_deg_s", kDrift, "deg/s", kDriftText, kOwn)
          .formerly({"least_velocity_deg_s"})};
  return kTable;
}

const SettingsTable<MonotoneTracking>& MonotoneTracking::table() {
  static const SettingsTable<MonotoneTracking> kTable = {
      Binding(&MonotoneTracking::leastVelocityDegS, "least_velocity_deg_s", kDrift, "deg/s", kDriftText, kOwn)
          .formerly({"least_velocity_deg_s"})};
  return kTable;
}

const SettingsTable<TemporalChannels>& TemporalChannels::table() {
  using S = TemporalChannels;
  static const SettingsTable<S> kTable = {
      {&S::windowS,
       "window_s",
       {0.05, 4.0},
       "s",
       "length of the impulse responses, half before the switch and half after it",
       kOwn},
      {&S::holdShare,
       "hold_share",
       {0.0, 1.0},
       "",
       "share of a frame's time during which the display shows it; 1: LCD, near 0: a flash",
       kOwn}};
  return kTable;
}

const SettingsTable<LevelsByPeak>& LevelsByPeak::table() {
  static const SettingsTable<LevelsByPeak> kTable = {
      Binding(&LevelsByPeak::leastPeakCpd, "least_peak_cpd", Range{0.01, 30.0}, "cpd",
              "smallest peak frequency of the coarsest contrast level", kModel)
          .formerly({"least_peak_cpd"})};
  return kTable;
}

const SettingsTable<LevelCount>& LevelCount::table() {
  static const SettingsTable<LevelCount> kTable = {
      Binding(&LevelCount::gaussian, "gaussian", Range{1, 12}, "",
              "levels of the Gaussian pyramid, two more than of contrast", kModel)
          .formerly({"gaussian_levels"})};
  return kTable;
}

const SettingsTable<PyramidBands>& PyramidBands::table() {
  static const SettingsTable<PyramidBands> kTable = {
      Binding(&PyramidBands::upsampler, "upsampler",
              "how coarser levels are upsampled: with the transposed kernel, or linearly", kOwn)
          .formerly({"upsampler"})};
  return kTable;
}

const SettingsTable<BandSettings>& BandSettings::table() {
  using S = BandSettings;
  static const SettingsTable<S> kTable = {
      Binding(&S::decomposition, "decomposition",
              "bands from a halving pyramid, or all at full size (slow, CPU only)", kModel)
          .formerly({"decomposition"}),
      {&S::levels, "levels", "number of levels", kModel},
      {&S::weights, "weights", "what a level's contrast is multiplied by", kModel},
      Binding(&S::kernelCentre, "kernel_centre", Range{0.3, 0.5}, "",
              "centre of the five-tap low-pass of Burt and Adelson; 0.375: binomial", kModel)
          .formerly({"kernel_centre"}),
      Binding(&S::peakModel, "peak_model", "frequency that a level represents", kModel)
          .formerly({"peak_model"}),
      Binding(&S::denominatorEpsilon, "denominator_epsilon", Range{1e-9, 10.0}, "cd/m2",
              "smallest cone response used as a contrast's denominator", kOwn)
          .formerly({"denominator_epsilon"})};
  return kTable;
}

const SettingsTable<PeakWeights>& PeakWeights::table() {
  static const SettingsTable<PeakWeights> kTable = {Binding(&PeakWeights::compensateGain, "compensate_gain",
                                                            "divide a level's contrast by its filter's gain",
                                                            kModel)
                                                        .formerly({"compensate_gain"})};
  return kTable;
}

bool BandSettings::compensatesGain() const {
  const auto* peak = std::get_if<PeakWeights>(&weights);
  return !peak || peak->compensateGain;
}

void BandSettings::check() const {
  if (isStack() && isFitted())
    throw Error("weights of a stack are not fitted", "weights",
                "choose weights: peak, or decomposition: pyramid");
}

Upsampler BandSettings::upsampler() const {
  const auto* pyramid = std::get_if<PyramidBands>(&decomposition);
  return pyramid && pyramid->upsampler == PyramidUpsampler::Linear ? Upsampler::Successive
                                                                   : Upsampler::Expand;
}

const SettingsTable<FixedAdaptation>& FixedAdaptation::table() {
  static const SettingsTable<FixedAdaptation> kTable = {Binding(&FixedAdaptation::luminanceCdM2,
                                                                "luminance_cd_m2", Range{1e-4, 1e4}, "cd/m2",
                                                                "luminance to which the eye is adapted", kOwn)
                                                            .formerly({"fixed_luminance_cd_m2"})};
  return kTable;
}

const SettingsTable<LevelAdaptation>& LevelAdaptation::table() {
  static const SettingsTable<LevelAdaptation> kTable = {
      Binding(&LevelAdaptation::level, "level", Range{0, 12}, "",
              "level of the Gaussian pyramid; 0: each pixel adapts to itself", kModel)
          .formerly({"adaptation_level"})};
  return kTable;
}

const SettingsTable<RegionSettings>& RegionSettings::table() {
  using S = RegionSettings;
  static const SettingsTable<S> kTable = {
      Binding(&S::thresholdJnd, "threshold_jnd", Range{1e-3, 1e3}, "JND",
              "smallest difference of a region's pixels", kRegions)
          .formerly({"region_threshold_jnd"}),
      Binding(&S::connectivity, "connectivity", oneOf({4, 8}), "", "neighbours of a pixel", kRegions)
          .formerly({"connectivity"}),
      Binding(&S::seeds, "seeds",
              "pixels of which a region must contain one: those where the input colours differ, or any",
              kRegions)
          .formerly({"seed_rule"})};
  return kTable;
}

const SettingsTable<RatingSettings>& RatingSettings::table() {
  using S = RatingSettings;
  static const SettingsTable<S> kTable = {
      Binding(&S::scale, "scale", Range{1e-3, 1e3}, "", "R = ln(scale Sigma) / ln(base)", kRegions)
          .formerly({"rating_scale"}),
      Binding(&S::base, "base", Range{1.001, 100.0}, "", "R = ln(scale Sigma) / ln(base)", kRegions)
          .formerly({"rating_base"})};
  return kTable;
}

const SettingsTable<PoppingSettings>& PoppingSettings::table() {
  using S = PoppingSettings;
  static const SettingsTable<S> kTable = {
      Binding(&S::model, "model",
              "sets the defaults of all other settings: castleCSF in absolute units, or the thesis's choices",
              "Ashraf et al. 2024; Schwarz 2009, section 10.3")
          .presets(&presetValues),
      {&S::sensitivity, "sensitivity",
       "contrast sensitivities of the channels, and their reference conditions"},
      {&S::eyeMovement, "eye_movement", "retinal velocity that remains after the eye's tracking", kModel},
      {&S::temporal, "temporal", "what is seen of a switch over time"},
      registeredChoice<MaskingInfo>(&S::masking, "masking", MaskingRegistry::instance().names(),
                                    "transducer of contrast", kModel),
      {&S::neighbourhood, "neighbourhood", "contrasts that mask a contrast besides itself",
       "Schwarz 2009, section 9.1.2"},
      {&S::bands, "bands", "how pictures are decomposed into frequency bands"},
      {&S::adaptation, "adaptation", "luminance to which the eye is adapted", kModel},
      {&S::minkowskiExponent,
       "minkowski_exponent",
       {1.0, 8.0},
       "",
       "exponent of the sums over levels and channels, and over a region",
       kRegions},
      {&S::collapse, "collapse",
       "whether coarse differences are interpolated before or after they are raised", kOwn},
      Binding(&S::disocclusion, "disocclusion", "how disocclusion weights differences", kRegions)
          .formerly({"use_disocclusion"}),
      Binding(&S::flicker, "flicker", "how flicker weights differences", "Schwarz 2009, section 10.3.5")
          .formerly({"use_flicker"}),
      {&S::regions, "regions", "pixels that pop together"},
      {&S::rating, "rating", "rating R of a region by its difference Sigma"},
      {&S::detection, "detection", "probability that a region of rating R is reported"}};
  return kTable;
}

PoppingSettings PoppingSettings::preset(PredictorModel model) {
  PoppingSettings out;
  out.model = model;
  if (model == PredictorModel::Limen2026) return out;
  out.sensitivity.achromatic = {{"daly98", {}}, AchromaticPeakScale{}};
  out.sensitivity.redGreen = {{"kelly83", {}}, ChromaticPeakScale{}};
  out.sensitivity.blueYellow = {{"kelly83", {}}, ChromaticPeakScale{.threshold = 0.012}};
  out.sensitivity.contrast = ConeContrast{};
  out.sensitivity.stimulusArea = ImageArea{};
  out.temporal = SingleFrame{};
  return out;
}

EyeMovement PoppingSettings::eyeModel() const {
  if (std::holds_alternative<LiteralTracking>(eyeMovement)) return EyeMovement::Literal;
  if (std::holds_alternative<FlooredTracking>(eyeMovement)) return EyeMovement::Floor;
  return std::holds_alternative<MonotoneTracking>(eyeMovement) ? EyeMovement::Monotone : EyeMovement::None;
}

double PoppingSettings::leastVelocityDegS() const {
  if (const auto* floor = std::get_if<FlooredTracking>(&eyeMovement)) return floor->leastVelocityDegS;
  if (const auto* monotone = std::get_if<MonotoneTracking>(&eyeMovement)) return monotone->leastVelocityDegS;
  return kLeastRetinalVelocityDegS;
}

DisocclusionSettings PoppingSettings::disocclusionSettings() const {
  const auto* given = std::get_if<DisocclusionSettings>(&disocclusion);
  return given ? *given : DisocclusionSettings{};
}

FlickerSettings PoppingSettings::flickerSettings() const {
  const auto* given = std::get_if<FlickerSettings>(&flicker);
  return given ? *given : FlickerSettings{};
}

}  // namespace limen::perception
