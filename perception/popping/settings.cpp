// SPDX-License-Identifier: BSD-3-Clause
#include "perception/popping/settings.h"

#include <algorithm>
#include <set>

#include "perception/vision/csf.h"
#include "perception/vision/masking.h"

namespace limen::perception {
namespace {

const std::vector<std::string> kEyeMovements = {"literal", "floor", "monotone", "none"};
const std::vector<std::string> kDecompositions = {"pyramid", "stack"};
const std::vector<std::string> kUpsamplers = {"linear", "expand"};
const std::vector<std::string> kAdaptations = {"local", "mean", "fixed"};
const std::vector<std::string> kCollapses = {"signed", "magnitude"};
const std::vector<std::string> kSeedRules = {"colour_differs", "none"};

/// Enumerators are declared in the order of their names.
template <class Enum>
Enum enumOf(const ParameterValues& values, const std::string& name, const std::vector<std::string>& names) {
  return static_cast<Enum>(std::find(names.begin(), names.end(), values.text(name)) - names.begin());
}
template <class Enum>
std::string nameOf(Enum value, const std::vector<std::string>& names) {
  return names[static_cast<size_t>(value)];
}

std::vector<std::string> chromaticCsfNames() {
  std::set<std::string> names;
  for (const Channel channel : {Channel::RedGreen, Channel::BlueYellow})
    for (const std::string& name : csfNames(channel)) names.insert(name);
  return {names.begin(), names.end()};
}

std::vector<Parameter> declare() {
  const PoppingSettings d;
  const std::string model = "Schwarz 2009, section 10.3.3", regions = "Schwarz 2009, section 10.3.4",
                    examples = "Schwarz 2009, section 10.3.5", choice = "choice";
  std::vector<Parameter> all = {
      realParameter("threshold_achromatic", d.thresholdAchromatic, 1e-5, 1.0, "contrast",
                    "luminance contrast that is just seen at the peak of sensitivity", model),
      realParameter("threshold_red_green", d.thresholdRedGreen, 1e-5, 1.0, "contrast",
                    "red-green contrast that is just seen at the peak of sensitivity", model),
      realParameter("threshold_blue_yellow", d.thresholdBlueYellow, 1e-5, 1.0, "contrast",
                    "blue-yellow contrast that is just seen at the peak of sensitivity", model),
      realParameter("calibration_velocity_deg_s", d.calibrationVelocityDegS, 0.01, 100.0, "deg/s",
                    "retinal velocity that the peak sensitivities refer to", choice),
      realParameter("calibration_luminance_cd_m2", d.calibrationLuminanceCdM2, 1e-3, 1e4, "cd/m2",
                    "adaptation luminance that the achromatic peak refers to", choice),
      realParameter("calibration_chromatic_cd_m2", d.calibrationChromaticCdM2, 1e-3, 1e4, "cd/m2",
                    "adaptation luminance that the chromatic peaks refer to", choice),
      realParameter("stimulus_area_deg2", d.stimulusAreaDeg2, 0.0, 1e5, "deg2",
                    "area in Barten's sensitivity; 0: that of the images on the display", model),
      booleanParameter("divide_grey_gain", d.divideGreyGain,
                       "divide A by 3.05, its value for a grey contrast of 1", choice),
      choiceParameter("csf_achromatic", d.csfAchromatic, csfNames(Channel::Achromatic),
                      "sensitivity of the achromatic channel", model),
      choiceParameter("csf_red_green", d.csfRedGreen, chromaticCsfNames(), "sensitivity of channel a", model),
      choiceParameter("csf_blue_yellow", d.csfBlueYellow, chromaticCsfNames(), "sensitivity of channel b",
                      model),
      realParameter("chromatic_reference_cd_m2", d.chromaticReferenceCdM2, 1e-3, 1e4, "cd/m2",
                    "luminance of the chromatic sensitivities' data", model),
      choiceParameter("masking", d.masking, MaskingRegistry::instance().names(), "transducer of contrast",
                      model),
      choiceParameter("eye_movement", nameOf(d.eyeMovement, kEyeMovements), kEyeMovements,
                      "how the eye's tracking leaves velocity on the retina", model),
      realParameter("least_velocity_deg_s", d.leastVelocityDegS, 1e-3, 10.0, "deg/s",
                    "retinal velocity that drift leaves at least (floor and monotone)", choice),
      integerParameter("gaussian_levels", d.gaussianLevels, 0, 12, "",
                       "levels of the Gaussian pyramid, two more than of contrast; 0: by least_peak_cpd",
                       model),
      realParameter("least_peak_cpd", d.leastPeakCpd, 0.01, 30.0, "cpd",
                    "least peak frequency of the coarsest contrast level", model),
      choiceParameter("decomposition", nameOf(d.decomposition, kDecompositions), kDecompositions,
                      "bands from a halving pyramid, or all at full size (slow, CPU only)", model),
      realParameter("kernel_centre", d.kernelCentre, 0.3, 0.5, "",
                    "centre of the five-tap low-pass of Burt and Adelson; 0.375: binomial", model),
      choiceParameter("upsampler", d.upsampler == Upsampler::Expand ? "expand" : "linear", kUpsamplers,
                      "how coarser levels reach the size of finer ones: the kernel transposed, or linearly",
                      choice),
      choiceParameter("peak_model", nameOf(d.peakModel, peakModelNames()), peakModelNames(),
                      "frequency that a level stands for", model),
      booleanParameter("compensate_gain", d.compensateGain, "divide a level's contrast by its filter's gain",
                       model),
      realParameter("denominator_epsilon", d.denominatorEpsilon, 1e-9, 10.0, "cd/m2",
                    "least cone response that a contrast is divided by", choice),
      choiceParameter("adaptation", nameOf(d.adaptation, kAdaptations), kAdaptations,
                      "luminance that the eye is adapted to: of about a degree, of the frame, or fixed",
                      model),
      integerParameter("adaptation_level", d.adaptationLevel, -1, 12, "",
                       "Gaussian level of local adaptation; -1: whose pixel is nearest to a degree", model),
      realParameter("fixed_luminance_cd_m2", d.fixedLuminanceCdM2, 1e-4, 1e4, "cd/m2",
                    "adaptation luminance of adaptation: fixed", choice),
      realParameter("minkowski_exponent", d.minkowskiExponent, 1.0, 8.0, "",
                    "of the sums over levels and channels, and over a region", regions),
      choiceParameter("collapse", nameOf(d.collapse, kCollapses), kCollapses,
                      "whether coarse differences are interpolated before or after they are raised", choice),
      booleanParameter("use_disocclusion", d.useDisocclusion, "heed the disocclusion weight", regions),
      booleanParameter("use_flicker", d.useFlicker, "heed the flicker weight", examples),
      realParameter("outside_visibility", d.outsideVisibility, 0.0, 1.0, "",
                    "visibility of what was outside the previous frame", choice),
      integerParameter("pcf_radius_px", d.pcfRadiusPx, 0, 8, "px",
                       "radius of the previous depth comparison; 0: the four nearest texels", choice),
      realParameter("depth_tolerance", d.depthTolerance, 0.0, 1.0, "",
                    "relative difference of depth within one surface", choice),
      realParameter("flicker_kappa", d.flickerKappa, 0.0, 10.0, "",
                    "colour difference over time, over that of the levels of detail, that counts as flicker",
                    choice),
      realParameter("flicker_max_displacement_px", d.flickerMaxDisplacementPx, 0.0, 1e4, "px",
                    "displacement from which on nothing counts as flicker", choice),
      realParameter("flicker_weight", d.flickerWeight, 0.0, 1.0, "", "weight of a flickering pixel", choice),
      realParameter("region_threshold_jnd", d.regionThresholdJnd, 1e-3, 1e3, "JND",
                    "difference of a region's pixels, at least", regions),
      choiceParameter("connectivity", std::to_string(d.connectivity), {"4", "8"}, "neighbours of a pixel",
                      regions),
      choiceParameter("seed_rule", nameOf(d.seedRule, kSeedRules), kSeedRules,
                      "pixels that a region needs one of: where the input colours differ, or any", regions),
      realParameter("rating_scale", d.ratingScale, 1e-3, 1e3, "",
                    "R = ln(rating_scale Sigma) / ln(rating_base)", regions),
      realParameter("rating_base", d.ratingBase, 1.001, 100.0, "",
                    "R = ln(rating_scale Sigma) / ln(rating_base)", regions)};
  for (Parameter& parameter : detectionParameters()) all.push_back(std::move(parameter));
  return all;
}

}  // namespace

const std::vector<Parameter>& poppingParameters() {
  static const std::vector<Parameter> kParameters = declare();
  return kParameters;
}

PoppingSettings PoppingSettings::from(const ParameterValues& values) {
  PoppingSettings s;
  s.thresholdAchromatic = values.real("threshold_achromatic");
  s.thresholdRedGreen = values.real("threshold_red_green");
  s.thresholdBlueYellow = values.real("threshold_blue_yellow");
  s.calibrationVelocityDegS = values.real("calibration_velocity_deg_s");
  s.calibrationLuminanceCdM2 = values.real("calibration_luminance_cd_m2");
  s.calibrationChromaticCdM2 = values.real("calibration_chromatic_cd_m2");
  s.stimulusAreaDeg2 = values.real("stimulus_area_deg2");
  s.divideGreyGain = values.boolean("divide_grey_gain");
  s.csfAchromatic = values.text("csf_achromatic");
  s.csfRedGreen = values.text("csf_red_green");
  s.csfBlueYellow = values.text("csf_blue_yellow");
  s.chromaticReferenceCdM2 = values.real("chromatic_reference_cd_m2");
  s.masking = values.text("masking");
  s.eyeMovement = enumOf<EyeMovement>(values, "eye_movement", kEyeMovements);
  s.leastVelocityDegS = values.real("least_velocity_deg_s");
  s.gaussianLevels = static_cast<int>(values.integer("gaussian_levels"));
  s.leastPeakCpd = values.real("least_peak_cpd");
  s.decomposition = enumOf<Decomposition>(values, "decomposition", kDecompositions);
  s.kernelCentre = values.real("kernel_centre");
  s.upsampler = values.text("upsampler") == "expand" ? Upsampler::Expand : Upsampler::Successive;
  s.peakModel = peakModelFromName(values.text("peak_model"));
  s.compensateGain = values.boolean("compensate_gain");
  s.denominatorEpsilon = values.real("denominator_epsilon");
  s.adaptation = enumOf<AdaptationSource>(values, "adaptation", kAdaptations);
  s.adaptationLevel = static_cast<int>(values.integer("adaptation_level"));
  s.fixedLuminanceCdM2 = values.real("fixed_luminance_cd_m2");
  s.minkowskiExponent = values.real("minkowski_exponent");
  s.collapse = enumOf<Collapse>(values, "collapse", kCollapses);
  s.useDisocclusion = values.boolean("use_disocclusion");
  s.useFlicker = values.boolean("use_flicker");
  s.outsideVisibility = values.real("outside_visibility");
  s.pcfRadiusPx = static_cast<int>(values.integer("pcf_radius_px"));
  s.depthTolerance = values.real("depth_tolerance");
  s.flickerKappa = values.real("flicker_kappa");
  s.flickerMaxDisplacementPx = values.real("flicker_max_displacement_px");
  s.flickerWeight = values.real("flicker_weight");
  s.regionThresholdJnd = values.real("region_threshold_jnd");
  s.connectivity = values.text("connectivity") == "4" ? 4 : 8;
  s.seedRule = enumOf<SeedRule>(values, "seed_rule", kSeedRules);
  s.ratingScale = values.real("rating_scale");
  s.ratingBase = values.real("rating_base");
  s.detection.guessRate = values.real("guess_rate");
  s.detection.lapseRate = values.real("lapse_rate");
  s.detection.midpointR = values.real("rating_midpoint");
  s.detection.scaleR = values.real("rating_scale_r");
  return s;
}

}  // namespace limen::perception
