// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "perception/popping/sensitivity.h"
#include "perception/popping/temporal_filter.h"
#include "perception/popping/temporal_settings.h"

/// The popping predictor over time: a switch of the level of detail as it appears to mechanisms that respond
/// to change, on a display that holds its frames.
///
/// Up to a moment the predicted content is shown, from then on the actual content. In the coordinates of what
/// the eye follows, the difference of both is a pattern that appears then and stays. Of a pattern that slips
/// over the retina with velocity v, a band at rho cpd flickers at rho v Hz: `steady` is a mechanism's
/// response to it for good, `onset` the largest one to its appearance (TemporalFilter::onset()). With
/// contrasts c of both in units of threshold, each mechanism's difference is
///
///     T(s m + o d / 2) - T(s m - o d / 2),   m = (c_actual + c_predicted) / 2,  d = c_actual - c_predicted
///
/// where s and o are the shares of steady and onset, and T is the transducer: at the moment of the switch a
/// mechanism with a symmetric impulse response sees the mean of both contents, which masks the change as far
/// as the mechanism sees steady content at all. With o = s this is T(s c_actual) - T(s c_predicted), the
/// single-frame form. The transient mechanism sees nothing of content at rest (s near 0), so that a change at
/// rest is not masked there; content that slips drives it, and masks. Differences of the sustained and the
/// transient mechanism add up, as their sensitivities do in castleCSF.
namespace limen::perception {

/// Factors on contrast that give units of threshold.
struct TemporalGain {
  double steady = 0.0, onset = 0.0;
};
using TemporalGains = std::array<TemporalGain, kTemporalMechanisms>;  ///< as kAllTemporalMechanisms

/// Sensitivities of the mechanisms at each level. Those of the settings' models, at the eye's drift, are
/// split by the shares that castleCSF gives its sustained and transient mechanisms there.
class TemporalSensitivity {
 public:
  TemporalSensitivity(const PoppingModel& model, const DisplayProfile& display,
                      const PoppingSettings& settings, const TemporalChannels& channels,
                      const Sensitivity& sensitivity);  ///< which must live longer
  TemporalSensitivity(const TemporalSensitivity&) = delete;
  TemporalSensitivity& operator=(const TemporalSensitivity&) = delete;
  /// Of level `level` at a retinal velocity and adaptation luminance; finite, >= 0.
  TemporalGains at(int level, double velocityDegS, double luminanceCdM2) const;
  /// The same before an onset is held to what is steady, which tables cannot interpolate over.
  TemporalGains apart(int level, double velocityDegS, double luminanceCdM2) const;
  /// Share of a level's contrast that hold blur leaves at a velocity on the screen, of which `retinalDegS` is
  /// left on the retina.
  double holdBlurAt(int level, double screenDegS, double retinalDegS) const;

 private:
  std::array<double, kTemporalMechanisms> amplitudes(int level, double luminanceCdM2) const;

  std::vector<double> peakCpd_;
  double areaDeg2_, refreshHz_, holdShare_, driftDegS_;
  const Sensitivity& sensitivity_;
  std::array<std::shared_ptr<const OnsetTable>, kTemporalMechanisms> onsets_;
  std::vector<std::vector<std::array<double, kTemporalMechanisms>>> byLevel_;  // over lg luminance
};

/// What mechanisms have of a switch: contrasts over their thresholds, before masking.
struct SwitchExtremes {
  std::array<double, kTemporalMechanisms> after{}, before{};
};
/// Contrasts are A (as luminance contrast if the settings say so), a, b over the band's gain.
SwitchExtremes switchExtremes(const std::array<double, 3>& actual, const TemporalGains& actualGains,
                              const std::array<double, 3>& predicted, const TemporalGains& predictedGains,
                              double holdBlur);
/// Channel of each mechanism: 0 A, 1 a, 2 b.
inline constexpr std::array<size_t, kTemporalMechanisms> kChannelOfMechanism = {0, 0, 1, 2};

/// Differences of channels A, a, b with point-wise masking.
std::array<double, 3> switchDifference(const std::array<double, 3>& actual, const TemporalGains& actualGains,
                                       const std::array<double, 3>& predicted,
                                       const TemporalGains& predictedGains, double holdBlur,
                                       const std::function<double(double)>& transducer);

}  // namespace limen::perception
