// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "perception/popping/band_weights.h"
#include "perception/popping/predictor.h"
#include "perception/vision/castle_csf.h"
#include "perception/vision/csf.h"

namespace limen::perception {

/// A positive function of one positive argument, tabulated over its logarithm and read by cubic
/// interpolation. Cells in which that misses the function by more than 1e-8 of its value (checked at three
/// places) and arguments outside the table are evaluated.
class FineTable {
 public:
  FineTable() = default;
  FineTable(std::function<double(double)> function, double low, double high, int cells);
  double operator()(double x) const;

 private:
  double interpolated(int cell, double t) const;
  std::function<double(double)> function_;
  double lnLow_ = 0.0, perLn_ = 0.0;
  int cells_ = 0;
  std::vector<double> values_;   // cells_ + 3: from one step below the table to one above
  std::vector<uint8_t> direct_;  // by cell
};

/// Calibrated sensitivities of the channels A, a, b for each level of the contrast pyramid: contrast times
/// sensitivity is in units of the visibility threshold.
class Sensitivity {
 public:
  /// `tables`: see PoppingOptions.
  Sensitivity(const PoppingModel& model, const DisplayProfile& display, const PoppingSettings& settings,
              bool tables);
  /// Of level `level` at its peak, at a retinal velocity and adaptation luminance; finite, >= 0.
  std::array<double, 3> at(int level, double velocityDegS, double luminanceCdM2) const;
  /// If weights are fitted: the contrasts of a level's parts times `relative`, [part][channel], of any sign,
  /// add up to a contrast at the level's peak, which is seen with the sensitivity `peak`.
  struct PartWeights {
    std::array<std::array<double, 3>, kBandParts> relative{};
    std::array<double, 3> peak{};
  };
  PartWeights weights(int level, double velocityDegS, double luminanceCdM2) const;
  /// Relative weights of the parts, by channel; their nodes are alike.
  const std::array<std::shared_ptr<const BandWeights>, 3>& partWeights() const { return weights_; }

 private:
  /// One channel's model. How it is evaluated depends on its inputs.
  struct Channel {
    std::shared_ptr<const Csf> csf;
    double scale = 1.0;
    enum class Kind { Direct, Daly98, Kelly83, Velocity, Luminance, Castle } kind = Kind::Direct;
    std::vector<FineTable> byLevel;  // Kelly83, Velocity, Luminance
    FineTable luminanceScale;        // Kelly83
    /// Castle: products of a function of luminance and one of velocity, by level, which are added.
    struct Product {
      CastleMechanism mechanism;
      std::vector<FineTable> luminance, velocity;  // velocity: none for the transient mechanism
    };
    std::vector<Product> products;
  };
  void fitWeights(const PoppingModel& model, const DisplayProfile& display, const PoppingSettings& settings);
  Channel makeChannel(const ChosenEntry& entry, double scale, bool tables) const;
  double evaluate(const Channel& channel, int level, double velocityDegS, double luminanceCdM2) const;

  std::vector<double> peakCpd_;
  CsfPoint viewing_;
  bool oneChromatic_;  ///< channels a and b share their model
  FineTable c0_, c1_;
  std::array<Channel, 3> channels_;
  std::array<std::shared_ptr<const BandWeights>, 3> weights_;  ///< null unless fitted
};

/// Factors that bring the peaks of the settings' sensitivities to 1 / threshold: K_A, K_a, K_b. Throws Error
/// on an unknown model or one whose peak is 0 there.
std::array<double, 3> calibration(const PoppingSettings& settings, const CsfPoint& viewing);
/// What a model needs about the viewer besides frequency, velocity and luminance.
CsfPoint viewingPoint(double areaDeg2, double widthDeg, const DisplayProfile& display);

}  // namespace limen::perception
