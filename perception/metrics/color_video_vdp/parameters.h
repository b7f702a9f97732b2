// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

namespace limen::perception::cvvdp {

/// A: sustained achromatic, RG: red-green, YV: yellow-violet, At: transient achromatic (videos only).
constexpr int kChannels = 4;
constexpr std::array<const char*, kChannels> kChannelNames = {"A", "RG", "YV", "At"};
/// One value per channel.
using Channels = std::array<double, kChannels>;

/// The constants of ColorVideoVDP. Those of the published parameter file, version 0.5.6, and those that stand
/// in the authors' program. Source: Mantiuk, Hanji, Ashraf, Asano and Chapiro, "ColorVideoVDP", ACM
/// Transactions on Graphics 43(4), 2024; data/README.md.
struct Parameters {
  double maskExponent;                               ///< p of the masked difference
  Channels maskerExponent;                           ///< q of each masker
  double maskScale;                                  ///< applied to the blurred mutual contrast
  std::array<Channels, kChannels> crossMasking;      ///< [masker][masked]
  double largestDifference;                          ///< where the soft limit tends to
  double sensitivityFactor;                          ///< on every contrast sensitivity
  double pixelExponent, bandExponent, channelExponent, frameExponent;  ///< of pooling
  Channels channelWeight, baseBandWeight;
  double imageFactor;                                ///< on the pooled difference of a single image
  double jodFactor, jodExponent;
  Channels temporalSigma, temporalBeta;

  // In the authors' program, not in the file.
  Channels channelGain = {1.0, 1.45, 1.0, 1.0};  ///< on contrasts before masking, not in the base band
  double powerOffset = 1e-5;                     ///< e of offsetPower()
  double leastBackground = 0.01;                 ///< of contrast's denominator, light units
  double largestContrast = 1000.0;               ///< limit of positive contrasts only
  double linearBelow = 0.1;                      ///< pooled differences up to this map linearly to JOD
  double transientPeakHz = 5.0, temporalWindowS = 0.25;
  double secondBandFrequency = 0.3228;  ///< centre of band 1, share of the Nyquist frequency
  double leastFrequencyCpd = 0.2, baseFrequencyCpd = 0.1;
  int blurRadius = 6;  ///< taps -6..6 of a Gaussian whose standard deviation is blurSigma
  double blurSigma;
};

/// As published.
const Parameters& parameters();

/// (x + e)^p - e^p for x >= 0: a power whose derivative at 0 is finite.
double offsetPower(double x, double exponent);

}  // namespace limen::perception::cvvdp
