// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "perception/metrics/color_video_vdp/comparison_input.h"
#include "perception/metrics/color_video_vdp/pooling.h"
#include "perception/multiscale/plane.h"

namespace limen::perception::cvvdp {

using Planes = std::array<Plane, kChannels>;  ///< of an image, the last is empty

/// Everything that is computed for one band of a frame.
struct BandStages {
  Planes testContrast, referenceContrast, sensitivity, difference;
};

/// For those who want to see inside; called after each frame.
struct FrameStages {
  int frame = 0;
  Planes test, reference;  ///< after the temporal filters, light units
  std::vector<BandStages> bands;
};
using StageVisitor = std::function<void(const FrameStages&)>;

/// A score, and with Options::map a map per frame: 1 - JOD / 10, so 0 is no difference and 0.1 one JOD; may
/// exceed 1.
struct ReferenceResult {
  Score score;
  std::vector<Plane> maps;
};

/// ColorVideoVDP in double precision on the CPU: the reference that the version on the GPU is tested against.
/// Throws Error like check(). Source: Mantiuk et al., "ColorVideoVDP", ACM Transactions on Graphics 43(4),
/// 2024, in the form of the authors' program, version 0.5.6.
ReferenceResult evaluate(const Pair& pair, const Options& options, const StageVisitor& visit = {});

}  // namespace limen::perception::cvvdp
