// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "perception/popping/settings.h"

namespace limen::perception {

/// A contrast level is split into this many parts: what a blur of 1 2 1 takes away, what a second one takes
/// away, and the rest down to the next level.
inline constexpr int kBandParts = 3;
/// Transfer of the parts of each level of a pyramid at `cyclesPerPx` of the finest level: [level][part].
std::vector<std::array<double, kBandParts>> bandPartTransfers(const BandSettings& bands, int levels,
                                                              double cyclesPerPx);

/// Transfer of the image of a frequency in the last part of each level: upsampling leaves of the next level's
/// samples a grating of 1/2 minus the frequency, in cycles per pixel of the level, beside the one wanted.
std::vector<double> bandImageTransfers(const BandSettings& bands, int levels, double cyclesPerPx);

/// Weights of the parts of every level, such that a grating whose contrast is 1 / sensitivity has a pooled
/// difference of 1 JND before masking, whatever its frequency. With one weight per level, read at the level's
/// peak, gratings between peaks and below the coarsest are up to 8 dB off, more where sensitivity falls fast.
///
/// The weights of all levels are fitted together for one retinal velocity and luminance (see
/// band_weights.cpp), at nodes in between which they are interpolated relative to the sensitivity at each
/// level's peak.
class BandWeights {
 public:
  struct Range {
    double low = 1.0, high = 1.0;
  };
  struct Setup {
    BandSettings bands;
    double minkowskiExponent = 2.4;
    double pixelsPerDegree = 40.0;
    std::vector<double> peakCpd;  ///< of each level
    Range velocityDegS, luminanceCdM2;
  };
  /// Calibrated sensitivity of a channel.
  using Sensitivity = std::function<double(double cpd, double velocityDegS, double luminanceCdM2)>;
  BandWeights(const Setup& setup, const Sensitivity& sensitivity);

  /// Weights of a level's parts over the sensitivity at its peak, or over kLeastSensitivity if that is less:
  /// the parts' contrasts times these add up to the contrast that the level's peak would have for the same
  /// response.
  std::array<double, kBandParts> at(int level, double velocityDegS, double luminanceCdM2) const;

  /// Nodes over ln of velocity or luminance; what lies beyond them is clamped.
  struct Axis {
    double lnLow = 0.0, perLn = 0.0;
    int nodes = 1;
    Axis() = default;
    Axis(Range range, double perOctave);
    double value(int node) const;
    /// Node and the next one's weight; clamped.
    std::pair<int, double> place(double value) const;
  };
  const Axis& velocityAxis() const { return velocity_; }
  const Axis& luminanceAxis() const { return luminance_; }
  /// at() at nodes; in between it is bilinear.
  const std::array<double, kBandParts>& atNode(int level, int velocity, int luminance) const {
    return nodes_[static_cast<size_t>(luminance) * velocity_.nodes + velocity][static_cast<size_t>(level)];
  }

  /// Where sensitivity is below this, no contrast reaches 2: there the fit only keeps responses small.
  static constexpr double kLeastSensitivity = 0.5;

 private:
  using Node = std::vector<std::array<double, kBandParts>>;  // by level
  Axis velocity_, luminance_;
  std::vector<Node> nodes_;  // [luminance][velocity]
};

/// The same for all with equal arguments; the last few are kept. `key` stands for `sensitivity`.
std::shared_ptr<const BandWeights> bandWeights(const BandWeights::Setup& setup, const std::string& key,
                                               const BandWeights::Sensitivity& sensitivity);

}  // namespace limen::perception
