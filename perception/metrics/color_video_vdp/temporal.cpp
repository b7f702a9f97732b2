// SPDX-License-Identifier: BSD-3-Clause
#include "perception/metrics/color_video_vdp/temporal.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace limen::perception::cvvdp {

int temporalTaps(double framesPerSecond) {
  return 2 * static_cast<int>(std::ceil(0.5 * parameters().temporalWindowS * framesPerSecond)) + 1;
}

std::vector<double> temporalFilter(int channel, double framesPerSecond) {
  const Parameters& p = parameters();
  const auto c = static_cast<size_t>(channel);
  const int count = temporalTaps(framesPerSecond), half = count / 2;
  std::vector<double> response;
  for (int k = 0; k <= half; ++k) {
    // The authors sample up to half the frame rate, although the last bin of an odd transform lies below it.
    const double frequency = half > 0 ? k * 0.5 * framesPerSecond / half : 0.0;
    const double warped = std::pow(frequency, p.temporalBeta[c]);
    const double offset = warped - std::pow(p.transientPeakHz, p.temporalBeta[c]);
    response.push_back(std::exp(-(channel == 3 ? offset * offset : warped) / p.temporalSigma[c]));
  }
  std::vector<double> taps;
  for (int n = -half; n <= half; ++n) {
    double sum = response[0];
    for (int k = 1; k <= half; ++k)
      sum += 2.0 * response[static_cast<size_t>(k)] * std::cos(2.0 * std::numbers::pi * k * n / count);
    taps.push_back(sum / count);
  }
  return taps;
}

int paddedFrame(int frame, int frames, TemporalPadding padding) {
  if (frame >= 0) return frame;
  if (padding == TemporalPadding::Replicate) return 0;
  assert(frames >= 2);
  const int span = frames - 1, before = -frame - 1;
  if (before / span % 2 == 0) return before % span + 1;
  return (frame % span + span) % span;
}

}  // namespace limen::perception::cvvdp
