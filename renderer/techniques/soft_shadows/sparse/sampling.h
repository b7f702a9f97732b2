// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "renderer/techniques/soft_shadows/sparse/reconstruction.h"

namespace limen::techniques {

/// How pixels share visibilities: which points the inner technique is asked for, and how every pixel's value
/// comes from theirs.
class SparseSampling {
 public:
  virtual ~SparseSampling() = default;
  /// The frame of the inner technique, each pixel of which is a chosen point, or sees nothing.
  virtual frame::Frame& points() = 0;
  /// Chooses the points of a frame; points() has begun.
  virtual void choose(frame::Frame& frame) = 0;
  /// Visibility of the whole picture from that of the points. `classes`, if given, gets a SampleClass for
  /// each pixel (R32UI).
  virtual void reconstruct(frame::Frame& frame, const gl::Texture& sampled, const gl::Texture& visibility,
                           const gl::Texture* classes) = 0;
};

/// Where a pixel's visibility comes from, as in the shaders.
enum SampleClass : uint32_t {
  NoReceiver = 0,
  Interpolated = 1,
  NearestInDepth = 2,  ///< no sample lies on its surface
  NoSample = 3,        ///< no sample in reach: taken as lit
  OwnSample = 4,       ///< it is a point that was asked for
  SampleClassCount = 5
};

/// Every factor-th pixel of rows and columns (of the picture itself, or of one rendered at lower resolution),
/// then interpolation.
std::unique_ptr<SparseSampling> makeUniformSampling(frame::Frame& frame, const ParameterValues& values);
/// The fewer pixels the wider a penumbra is on the screen, then pull-push.
std::unique_ptr<SparseSampling> makeAdaptiveSampling(frame::Frame& frame, const ParameterValues& values);

}  // namespace limen::techniques
