// SPDX-License-Identifier: BSD-3-Clause
#include "perception/threshold_maps/settings.h"

#include <algorithm>

#include "perception/vision/csf.h"
#include "perception/vision/masking.h"
#include "perception/vision/tvi.h"

namespace limen::perception {
namespace {

const char* const kMap = "Schwarz 2009, section 9.4";
const char* const kOriginal = "Ramasubramanian et al. 1999; Schwarz 2009, section 9.2";

/// Index of the chosen one of `choices`.
template <class Enum>
Enum chosen(const ParameterValues& values, const char* name, const std::vector<std::string>& choices) {
  const std::string& text = values.text(name);
  return static_cast<Enum>(std::find(choices.begin(), choices.end(), text) - choices.begin());
}

// Functions, since techniques declare their parameters before objects of other files exist.
std::vector<std::string> decompositions() { return {"stack", "pyramid", "true_stack", "repeated"}; }
std::vector<std::string> adaptations() {
  return {"one_degree", "nearest_level", "fractional_level", "level", "mistaken_degree"};
}
std::vector<std::string> frequencyRules() { return {"original", "actual", "none"}; }
std::vector<std::string> lowFrequencies() { return {"by_rule", "one", "as_computed"}; }

std::vector<std::string> achromaticCsfs() {
  return {"barten89", "barten89_size",   "barten03", "martin92", "daly93",   "kelly79",
          "daly98",   "burbeck_kelly80", "laird06",  "stelacsf", "castlecsf"};
}
std::vector<std::string> maskings() { return {"none", "daly", "lubin", "self", "schwarz"}; }

}  // namespace

Kernel ThresholdMapSettings::kernel() const {
  if (nineFetch) return Kernel::nineFetch6();
  return burt ? Kernel::burt6(burtA) : Kernel::fused6();
}

PyramidSettings ThresholdMapSettings::pyramid() const {
  const Upsampler successive = expand ? Upsampler::Expand : Upsampler::Successive;
  return {levels, kernel(), decomposition == Decomposition::Pyramid ? Upsampler::Bilinear : successive,
          border};
}

std::vector<Parameter> thresholdMapParameters() {
  return {
      integerParameter("levels", 7, 3, 9, "", "levels of the Gaussian pyramid; two fewer contrast levels",
                       kMap),
      choiceParameter(
          "decomposition", "stack", decompositions(),
          "stack: levels upsampled one at a time; pyramid: sampled directly; reference only: true_stack, "
          "Gaussians of doubling sigma; repeated, one small kernel again and again, a published mistake",
          kMap),
      choiceParameter("downsample", "exact", {"exact", "nine_fetch"},
                      "six taps an axis, or the thesis's nine bilinear fetches, which equal them for even "
                      "sizes only",
                      kMap),
      choiceParameter("kernel", "binomial", {"binomial", "burt"},
                      "the 5x5 kernel before the bilinear step, which the thesis does not name (exact only)",
                      kMap),
      realParameter("burt_a", 0.4, 0.25, 0.6, "", "centre weight of kernel: burt; 0.375 is the binomial",
                    "Burt and Adelson 1983"),
      choiceParameter("upsampler", "bilinear", {"bilinear", "expand"},
                      "how a stack brings levels up: bilinearly, or with the kernel (reference only)", kMap),
      choiceParameter("border", "clamp", {"clamp", "mirror"}, "what lies beyond the image's edge", ""),
      realParameter("stack_sigma_px", 0.0, 0.0, 16.0, "px",
                    "sigma of level 1 of a true stack; 0: as the pyramid's kernel has in the limit",
                    "Schwarz 2009, section 9.1.3"),
      choiceParameter("peak_model", "no_upsample", peakModelNames(),
                      "where the bands' peak frequencies are taken to lie; halving is wrong, to compare with",
                      "Schwarz 2009, section 10.3"),
      booleanParameter("gain_compensation", false, "divide each band by its peak gain",
                       "Schwarz 2009, section 10.3"),
      choiceParameter(
          "adaptation", "one_degree", adaptations(),
          "adaptation luminance: mean over one degree (two levels blended), level round(lg2 ppd), levels "
          "around lg2 ppd blended, a given level; reference only: mistaken_degree, the image's degrees "
          "taken for the pixels to average, a published mistake",
          kMap),
      integerParameter("adaptation_level", 5, 0, 8, "", "for adaptation: level; 0: every pixel its own",
                       kMap),
      choiceParameter("csf", "barten89", achromaticCsfs(), "contrast sensitivity function", kOriginal),
      choiceParameter("masking", "daly", maskings(), "threshold elevation by contrast; none switches it off",
                      kOriginal),
      choiceParameter("tvi", "ward", tviNames(), "threshold versus intensity", kOriginal),
      choiceParameter(
          "f_rule", "actual", frequencyRules(),
          "threshold elevation by frequency: at f_luminance_cd_m2, at the adaptation luminance, or "
          "none",
          "Schwarz 2009, (9.11) and section 9.4"),
      realParameter("f_luminance_cd_m2", 100.0, 1e-4, 1e5, "cd/m2", "luminance of f_rule: original",
                    "Schwarz 2009, (9.11)"),
      choiceParameter("f_low", "by_rule", lowFrequencies(),
                      "frequency elevation below f_low_cpd: one, as computed, or (by_rule) one for f_rule: "
                      "original alone",
                      "Schwarz 2009, section 9.2, footnote"),
      realParameter("f_low_cpd", 4.0, 0.0, 60.0, "cpd", "frequency below which f_low holds",
                    "Schwarz 2009, section 9.2, footnote"),
      realParameter("tvi_factor", 0.2, 0.0, 10.0, "", "share of the TVI that is the threshold",
                    "Schwarz 2009, section 9.2"),
      choiceParameter(
          "flat_rule", "smooth", {"smooth", "exact"},
          "elevation where there is no contrast: (sum + epsilon) / (sum + epsilon), at least 1; or "
          "1 where the sum is exactly 0",
          ""),
      realParameter("flat_epsilon", 1e-4, 1e-12, 0.1, "",
                    "contrast that flat_rule: smooth adds; a fiftieth of what is just visible", ""),
      realParameter("contrast_epsilon_cd_m2", 1e-4, 1e-9, 10.0, "cd/m2",
                    "least denominator of a contrast; smaller ones are counted", ""),
      realParameter("largest_cd_m2", 6e4, 1.0, 1e6, "cd/m2",
                    "brighter pixels count as this; above 6e4 16-bit results overflow", ""),
  };
}

std::vector<Parameter> thresholdMapGpuParameters() {
  return {choiceParameter("precision", "32", {"16", "32"}, "bits of intermediate results", kMap),
          choiceParameter("lookup", "tables", {"tables", "direct"},
                          "CSF and TVI from tables over luminance, or computed for every pixel (barten89 and "
                          "ward only)",
                          kMap),
          integerParameter(
              "levels_per_pass", 0, 0, 3, "",
              "pyramid levels that a pass makes from level 1 on; 0: one of large levels, three of small "
              "ones; a matter of speed alone")};
}

ThresholdMapSettings thresholdMapSettings(const ParameterValues& values) {
  ThresholdMapSettings out;
  using Settings = ThresholdMapSettings;
  out.levels = static_cast<int>(values.integer("levels"));
  out.decomposition = chosen<Settings::Decomposition>(values, "decomposition", decompositions());
  out.nineFetch = values.text("downsample") == "nine_fetch";
  out.burt = values.text("kernel") == "burt";
  out.burtA = values.real("burt_a");
  out.expand = values.text("upsampler") == "expand";
  out.border = values.text("border") == "mirror" ? Border::Mirror : Border::Clamp;
  out.stackSigmaPx = values.real("stack_sigma_px");
  out.peakModel = peakModelFromName(values.text("peak_model"));
  out.gainCompensation = values.boolean("gain_compensation");
  out.adaptation = chosen<Settings::Adaptation>(values, "adaptation", adaptations());
  out.adaptationLevel = static_cast<int>(values.integer("adaptation_level"));
  out.csf = values.text("csf");
  out.masking = values.text("masking");
  out.tvi = values.text("tvi");
  out.frequencyRule = chosen<Settings::FrequencyRule>(values, "f_rule", frequencyRules());
  out.fLuminanceCdM2 = values.real("f_luminance_cd_m2");
  out.fLow = chosen<Settings::LowFrequencies>(values, "f_low", lowFrequencies());
  out.fLowCpd = values.real("f_low_cpd");
  out.tviFactor = values.real("tvi_factor");
  out.flatSmooth = values.text("flat_rule") == "smooth";
  out.flatEpsilon = values.real("flat_epsilon");
  out.contrastEpsilonCdM2 = values.real("contrast_epsilon_cd_m2");
  out.largestCdM2 = values.real("largest_cd_m2");
  if (values.has("precision")) out.half = values.text("precision") == "16";
  if (values.has("levels_per_pass")) out.levelsPerPass = static_cast<int>(values.integer("levels_per_pass"));
  if (values.has("lookup")) out.direct = values.text("lookup") == "direct";
  if (out.nineFetch && out.burt)
    throw Error("nine fetches stand for the binomial kernel, not for 'burt'", "kernel",
                "use downsample: exact");
  return out;
}

}  // namespace limen::perception
