// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "experiments/base/parameter.h"
#include "perception/multiscale/band_peaks.h"
#include "perception/popping/detection.h"
#include "perception/vision/eye_movement.h"

namespace limen::perception {

/// Where bands come from.
enum class Decomposition {
  Pyramid,  ///< halved level by level, as the thesis does
  Stack     ///< every level at full size: what the pyramid approximates; on the CPU only
};
/// Luminance that the eye is adapted to.
enum class AdaptationSource {
  Local,  ///< the pyramid level whose pixel is about one degree
  Mean,   ///< mean of the frame
  Fixed   ///< fixedLuminanceCdM2
};
/// How a coarse level's response difference reaches the pixels of the finest.
enum class Collapse {
  Signed,    ///< interpolated, then raised: as if every level had been kept at full size
  Magnitude  ///< raised, then interpolated
};
enum class SeedRule {
  ColourDiffers,  ///< a region needs a pixel where the input colours differ
  None
};

/// Every constant of the popping predictor, each one a declared parameter (`poppingParameters()`). Schwarz
/// 2009, section 10.3.3 and 10.3.4.
struct PoppingSettings {
  // Contrast that is just seen at the sensitivity's peak, by channel (A, a, b).
  double thresholdAchromatic = 0.005, thresholdRedGreen = 0.010, thresholdBlueYellow = 0.012;
  double calibrationVelocityDegS = 0.15;    ///< retinal velocity the peaks refer to
  double calibrationLuminanceCdM2 = 100.0;  ///< of the achromatic peak
  double calibrationChromaticCdM2 = 35.0;   ///< of the chromatic peaks
  double stimulusAreaDeg2 = 0.0;            ///< of Barten's CSF; 0: of the images on the display
  bool divideGreyGain = true;               ///< divide A by 3.05, so that it is luminance contrast
  std::string csfAchromatic = "daly98";     ///< names in CsfRegistry
  std::string csfRedGreen = "kelly83", csfBlueYellow = "kelly83";
  double chromaticReferenceCdM2 = 35.0;  ///< at which Kelly 1983 needs no scale
  std::string masking = "schwarz";       ///< name in MaskingRegistry
  EyeMovement eyeMovement = EyeMovement::Monotone;
  double leastVelocityDegS = kLeastRetinalVelocityDegS;

  int gaussianLevels = 0;     ///< 0: all whose contrast level peaks at leastPeakCpd or above
  double leastPeakCpd = 0.5;  ///< of the coarsest contrast level
  Decomposition decomposition = Decomposition::Pyramid;
  double kernelCentre = 0.375;  ///< a of the low-pass 1/4 - a/2, 1/4, a, 1/4, 1/4 - a/2; 0.375: binomial
  Upsampler upsampler = Upsampler::Expand;  ///< of coarser levels: Expand or Successive (linear)
  PeakModel peakModel = PeakModel::WithUpsample;
  bool compensateGain = true;        ///< divide a level's contrast by its filter's gain
  double denominatorEpsilon = 1e-3;  ///< least cone response that a contrast is divided by [cd/m2]
  AdaptationSource adaptation = AdaptationSource::Local;
  int adaptationLevel = -1;  ///< of the Gaussian pyramid; -1: round(lg2 of pixels per degree)
  double fixedLuminanceCdM2 = 100.0;

  double minkowskiExponent = 2.4;
  Collapse collapse = Collapse::Signed;

  bool useDisocclusion = true, useFlicker = true;  ///< heed these weight maps where they are given
  double outsideVisibility = 0.0;                  ///< of a pixel whose previous place lies outside the frame
  int pcfRadiusPx = 0;           ///< taps of the depth comparison: (2 r + 1)^2 places, four texels each
  double depthTolerance = 0.01;  ///< relative difference of linear depth that is still the same surface
  double flickerKappa = 0.9;     ///< flicker: dE94 over time >= kappa * dE94 between the LODs ...
  double flickerMaxDisplacementPx = 8.0;  ///< ... unless the pixel moves by this much or more
  double flickerWeight = 0.25;            ///< of a flickering pixel

  double regionThresholdJnd = 2.0;  ///< inclusive
  int connectivity = 8;             ///< 4 or 8
  SeedRule seedRule = SeedRule::ColourDiffers;
  double ratingScale = 0.375, ratingBase = 2.25;  ///< R = ln(scale * Sigma) / ln(base)
  DetectionModel detection;

  Kernel kernel() const { return Kernel::burt5(kernelCentre); }

  /// Throws Error on an unknown name of a CSF or masking model, or a value out of its range.
  static PoppingSettings from(const ParameterValues& values);
};

/// Declaration of all of PoppingSettings, detection model included. Names as the members', in snake_case.
const std::vector<Parameter>& poppingParameters();

}  // namespace limen::perception
