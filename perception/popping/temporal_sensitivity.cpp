// SPDX-License-Identifier: BSD-3-Clause
#include "perception/popping/temporal_sensitivity.h"

#include <algorithm>
#include <cmath>

namespace limen::perception {
namespace {

// Nodes of amplitudes over luminance, 64 a decade: between them they are straight within 1e-4.
constexpr double kLow = 1e-4, kHigh = 1e4;  // cd/m2
constexpr int kNodes = 513;

}  // namespace

TemporalSensitivity::TemporalSensitivity(const PoppingModel& model, const DisplayProfile& display,
                                         const PoppingSettings& settings, const TemporalChannels& channels,
                                         const Sensitivity& sensitivity)
    : peakCpd_(model.peakCpd),
      areaDeg2_(model.areaDeg2),
      refreshHz_(display.refreshHz),
      holdShare_(channels.holdShare),
      driftDegS_(settings.leastVelocityDegS()),
      sensitivity_(sensitivity) {
  for (size_t m = 0; m < kTemporalMechanisms; ++m)
    onsets_[m] = OnsetTable::shared(kAllTemporalMechanisms[m], display.refreshHz, channels.windowS);
  for (int level = 0; level < model.contrastLevels; ++level) {
    std::vector<std::array<double, kTemporalMechanisms>> nodes;
    for (int i = 0; i < kNodes; ++i)
      nodes.push_back(amplitudes(level, kLow * std::pow(kHigh / kLow, i / (kNodes - 1.0))));
    byLevel_.push_back(std::move(nodes));
  }
}

std::array<double, kTemporalMechanisms> TemporalSensitivity::amplitudes(int level,
                                                                        double luminanceCdM2) const {
  const double cpd = peakCpd_[static_cast<size_t>(level)], drift = cpd * driftDegS_;
  const std::array<double, 3> atDrift = sensitivity_.at(level, driftDegS_, luminanceCdM2);
  std::array<double, kTemporalMechanisms> spatial{}, seen{};
  for (size_t m = 0; m < kTemporalMechanisms; ++m) {
    spatial[m] = castleSpatial(kAllTemporalMechanisms[m], cpd, luminanceCdM2, areaDeg2_);
    seen[m] = spatial[m] * castleTemporal(kAllTemporalMechanisms[m], drift, luminanceCdM2);
  }
  const auto scale = [](double sensitivity, double castle) {
    return castle > 0.0 ? sensitivity / castle : 0.0;
  };
  const double achromatic = scale(atDrift[0], seen[0] + seen[1]);
  return {achromatic * spatial[0], achromatic * spatial[1], scale(atDrift[1], seen[2]) * spatial[2],
          scale(atDrift[2], seen[3]) * spatial[3]};
}

TemporalGains TemporalSensitivity::at(int level, double velocityDegS, double luminanceCdM2) const {
  TemporalGains out = apart(level, velocityDegS, luminanceCdM2);
  for (auto& gain : out) gain.onset = std::max(gain.steady, gain.onset);
  return out;
}

TemporalGains TemporalSensitivity::apart(int level, double velocityDegS, double luminanceCdM2) const {
  const auto i = static_cast<size_t>(level);
  const double hz = peakCpd_[i] * velocityDegS, l = std::clamp(luminanceCdM2, kLow, kHigh);
  const double place = std::log(l / kLow) / std::log(kHigh / kLow) * (kNodes - 1);
  const auto node = static_cast<size_t>(std::clamp(place, 0.0, kNodes - 2.0));
  const double t = place - static_cast<double>(node);
  TemporalGains out;
  for (size_t m = 0; m < kTemporalMechanisms; ++m) {
    const double amplitude = (1.0 - t) * byLevel_[i][node][m] + t * byLevel_[i][node + 1][m];
    out[m].steady = amplitude * castleTemporal(kAllTemporalMechanisms[m], hz, l);
    out[m].onset = amplitude * (*onsets_[m])(hz, l);
  }
  return out;
}

double TemporalSensitivity::holdBlurAt(int level, double screenDegS, double retinalDegS) const {
  // The eye moves with what it follows of the screen's motion.
  return holdBlur(peakCpd_[static_cast<size_t>(level)], std::max(0.0, screenDegS - retinalDegS), refreshHz_,
                  holdShare_);
}

SwitchExtremes switchExtremes(const std::array<double, 3>& actual, const TemporalGains& actualGains,
                              const std::array<double, 3>& predicted, const TemporalGains& predictedGains,
                              double holdBlur) {
  SwitchExtremes out;
  for (size_t m = 0; m < kTemporalMechanisms; ++m) {
    const double a = holdBlur * actual[kChannelOfMechanism[m]],
                 p = holdBlur * predicted[kChannelOfMechanism[m]];
    const double mean = 0.5 * (actualGains[m].steady * a + predictedGains[m].steady * p);
    const bool isSame = a == p && actualGains[m].steady == predictedGains[m].steady;
    const double half = isSame ? 0.0 : 0.5 * (actualGains[m].onset * a - predictedGains[m].onset * p);
    out.after[m] = mean + half, out.before[m] = mean - half;
  }
  return out;
}

std::array<double, 3> switchDifference(const std::array<double, 3>& actual, const TemporalGains& actualGains,
                                       const std::array<double, 3>& predicted,
                                       const TemporalGains& predictedGains, double holdBlur,
                                       const std::function<double(double)>& transducer) {
  std::array<double, 3> out{};
  const SwitchExtremes extremes = switchExtremes(actual, actualGains, predicted, predictedGains, holdBlur);
  for (size_t m = 0; m < kTemporalMechanisms; ++m)
    if (extremes.after[m] != extremes.before[m])
      out[kChannelOfMechanism[m]] += transducer(extremes.after[m]) - transducer(extremes.before[m]);
  return out;
}

}  // namespace limen::perception
