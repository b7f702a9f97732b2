// SPDX-License-Identifier: BSD-3-Clause
#include "perception/metrics/color_video_vdp/pooling.h"

#include <cmath>

namespace limen::perception::cvvdp {
namespace {

size_t channelCount(bool video) { return video ? kChannels : kChannels - 1; }

double weight(size_t channel, bool baseBand) {
  const Parameters& p = parameters();
  return p.channelWeight[channel] * (baseBand ? p.baseBandWeight[channel] : 1.0);
}

}  // namespace

double jodOf(double difference) {
  const Parameters& p = parameters();
  if (difference > p.linearBelow) return 10.0 - p.jodFactor * std::pow(difference, p.jodExponent);
  return 10.0 - p.jodFactor * std::pow(p.linearBelow, p.jodExponent - 1.0) * difference;
}

double poolFrame(const FrameDifferences& frame, bool video) {
  const Parameters& p = parameters();
  double channels = 0.0;
  for (size_t c = 0; c < channelCount(video); ++c) {
    double bands = 0.0;
    for (size_t b = 0; b < frame.size(); ++b)
      bands += offsetPower(weight(c, b + 1 == frame.size()) * frame[b][c], p.bandExponent);
    channels += offsetPower(offsetPower(bands, 1.0 / p.bandExponent), p.channelExponent);
  }
  return offsetPower(channels, 1.0 / p.channelExponent);
}

double frameDifference(const FrameDifferences& frame, bool video) {
  return (video ? 1.0 : parameters().imageFactor) * poolFrame(frame, video);
}

Score pool(std::vector<FrameDifferences> frames, std::vector<double> frequenciesCpd, bool video) {
  const Parameters& p = parameters();
  Score out;
  double sum = 0.0;
  for (const FrameDifferences& frame : frames) {
    const double difference = frameDifference(frame, video);
    out.frameJod.push_back(jodOf(difference));
    sum += offsetPower(difference, p.frameExponent);
    out.difference = difference;
  }
  if (video) out.difference = offsetPower(sum / static_cast<double>(frames.size()), 1.0 / p.frameExponent);
  out.jod = jodOf(out.difference);
  out.frames = std::move(frames);
  out.frequenciesCpd = std::move(frequenciesCpd);
  out.video = video;
  return out;
}

double distogramJod(double difference, int channel, bool baseBand, bool video) {
  const auto count = static_cast<double>(channelCount(video));
  return 10.0 - jodOf(count * weight(static_cast<size_t>(channel), baseBand) * difference);
}

}  // namespace limen::perception::cvvdp
