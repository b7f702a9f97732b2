// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "perception/metrics/color_video_vdp/parameters.h"

namespace limen::perception::cvvdp {

/// Differences of a frame pooled over the pixels of each band, by band and channel; before all weights.
using FrameDifferences = std::vector<Channels>;

/// What the metric says of a pair of images or videos.
struct Score {
  double jod = 10.0;         ///< just-objectionable differences: 10 is no difference; not bounded below
  double difference = 0.0;   ///< pooled difference that `jod` is a function of
  std::vector<double> frameJod;  ///< of each frame alone
  std::vector<FrameDifferences> frames;
  std::vector<double> frequenciesCpd;  ///< of the bands; the last is the base band's
  bool video = false;
};

/// Pooled difference to JOD.
double jodOf(double difference);
/// Over bands and channels of a frame, without the factor of images.
double poolFrame(const FrameDifferences& frame, bool video);
/// Of a frame alone: a difference on the scale of the result.
double frameDifference(const FrameDifferences& frame, bool video);
/// Over everything.
Score pool(std::vector<FrameDifferences> frames, std::vector<double> frequenciesCpd, bool video);

/// JOD that one channel of one band of one frame would cost if all were alike: the authors' distogram.
double distogramJod(double difference, int channel, bool baseBand, bool video);

}  // namespace limen::perception::cvvdp
