// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "perception/metrics/color_video_vdp/parameters.h"

namespace limen::perception::cvvdp {

constexpr int kSensitivityLevels = 32;

/// Contrast sensitivity of one channel at one spatial frequency, by background luminance: castleCSF as
/// tabulated with the metric, stimulus size fixed. Frequencies beyond the table go on with its end slope,
/// luminances are clamped to it.
class Sensitivity {
 public:
  Sensitivity(int channel, double frequencyCpd);
  /// Of a background of 10^`logBackground` cd/m2.
  double at(double logBackground) const;
  /// log10 of the sensitivity at equal steps of log10 of the background, correction included.
  const std::array<double, kSensitivityLevels>& logs() const { return logs_; }

  static double firstLogBackground();
  static double lastLogBackground();

 private:
  std::array<double, kSensitivityLevels> logs_{};
};

}  // namespace limen::perception::cvvdp
