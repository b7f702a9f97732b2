// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "experiments/base/parameter.h"
#include "perception/multiscale/band_peaks.h"

/// Threshold maps: for each pixel of one image the luminance increment that stays invisible. Sources:
/// Ramasubramanian et al. 1999; Schwarz 2009, sections 9.2 and 9.4.
namespace limen::perception {

struct ThresholdMapSettings {
  enum class Decomposition {
    Stack,      ///< pyramid whose levels are brought up one level at a time (section 9.4)
    Pyramid,    ///< pyramid sampled directly: faster, blocky
    TrueStack,  ///< Gaussians of doubling sigma at full resolution: what both stand for (CPU only)
    Repeated    ///< a published mistake (section 9.6): one small kernel applied again and again (CPU only)
  };
  enum class Adaptation {
    OneDegree,        ///< mean over one degree: the two levels that enclose it, blended
    NearestLevel,     ///< level round(lg2 ppd), whose pixels are about a degree apart
    FractionalLevel,  ///< levels around lg2 ppd, blended
    Level,            ///< level `adaptationLevel`; 0: each pixel adapts to itself
    MistakenDegree    ///< a published mistake (section 9.6): a count of degrees taken for pixels (CPU only)
  };
  enum class FrequencyRule {
    Original,  ///< at `fLuminanceCdM2`
    Actual,    ///< at the adaptation luminance
    None       ///< 1
  };
  enum class LowFrequencies { ByRule, One, AsComputed };

  int levels = 7;
  Decomposition decomposition = Decomposition::Stack;
  bool nineFetch = false;  ///< downsample as the thesis's nine bilinear fetches
  bool burt = false;       ///< Burt's five taps in place of the binomial ones
  double burtA = 0.4;
  bool expand = false;  ///< Stack: bring levels up with the kernel in place of bilinearly (CPU only)
  Border border = Border::Clamp;
  double stackSigmaPx = 0.0;
  PeakModel peakModel = PeakModel::NoUpsample;
  bool gainCompensation = false;
  Adaptation adaptation = Adaptation::OneDegree;
  int adaptationLevel = 5;
  std::string csf = "barten89", masking = "daly", tvi = "ward";
  FrequencyRule frequencyRule = FrequencyRule::Actual;
  double fLuminanceCdM2 = 100.0;
  LowFrequencies fLow = LowFrequencies::ByRule;
  double fLowCpd = 4.0;
  double tviFactor = 0.2;
  bool flatSmooth = true;
  double flatEpsilon = 1e-4;
  double contrastEpsilonCdM2 = 1e-4;
  double largestCdM2 = 6e4;
  // GPU only:
  bool half = false;      ///< intermediate results in 16 bits in place of 32
  int levelsPerPass = 0;  ///< of the pyramid, from level 1; 0: one for large levels, three for small ones
  bool direct = false;    ///< CSF computed per pixel in place of read from tables

  /// Five taps and how they are applied.
  Kernel kernel() const;
  PyramidSettings pyramid() const;
};

/// Declarations of the above, those of the GPU aside.
std::vector<Parameter> thresholdMapParameters();
/// `precision` (16 or 32 bits), `lookup` (tables or direct) and `levels_per_pass`.
std::vector<Parameter> thresholdMapGpuParameters();
/// Values of thresholdMapParameters(), and of thresholdMapGpuParameters() where given.
ThresholdMapSettings thresholdMapSettings(const ParameterValues& values);

}  // namespace limen::perception
