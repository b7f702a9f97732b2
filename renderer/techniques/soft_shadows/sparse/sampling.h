// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "experiments/base/chosen_entry.h"
#include "renderer/techniques/soft_shadows/sparse/reconstruction.h"
#include "renderer/techniques/soft_shadows/sparse/sparse_bindings.h"

namespace limen::techniques {

/// What a uniform grid of samples consists of.
enum class GridPoints { Subset, Rendered };
constexpr EnumNames<GridPoints, 2> enumNames(GridPoints) {
  return {{{{GridPoints::Subset, "subset"}, {GridPoints::Rendered, "rendered"}}}};
}

struct UniformSamplingSettings {
  static constexpr const char *kKind = "uniform", *kSummary = "samples on a grid, then interpolation";
  int factor = 2;  ///< pixels between samples, along rows and columns
  GridPoints points = GridPoints::Subset;
  double normalPower = 4.0;
  static const SettingsTable<UniformSamplingSettings>& table();
};

struct AdaptiveSamplingSettings {
  static constexpr const char *kKind = "adaptive",
                              *kSummary = "fewer samples the wider the penumbra on screen, then pull-push";
  double minSamples = 8.0;
  int coarsestLevel = 3;
  static const SettingsTable<AdaptiveSamplingSettings>& table();
};

/// How pixels share visibilities: for which points the inner technique runs, and how every pixel's value is
/// derived from theirs.
class SparseSampling {
 public:
  virtual ~SparseSampling() = default;
  /// The frame of the inner technique, each pixel of which is a chosen point or empty.
  virtual frame::Frame& points() = 0;
  /// Chooses the points of a frame; points() has begun.
  virtual void choose(frame::Frame& frame) = 0;
  /// Visibility of the whole picture from that of the points. `classes`, if given, gets a SampleClass for
  /// each pixel (R32UI).
  virtual void reconstruct(frame::Frame& frame, const gl::Texture& sampled, const gl::Texture& visibility,
                           const gl::Texture* classes) = 0;
};

/// Where a pixel's visibility comes from: see sparse_bindings.h.
enum SampleClass : uint32_t {
  NoReceiver = kClassNoReceiver,
  Interpolated = kClassInterpolated,
  NearestInDepth = kClassNearestInDepth,
  NoSample = kClassNoSample,
  OwnSample = kClassOwnSample,
  SampleClassCount = kSampleClassCount
};

/// Every factor-th pixel of rows and columns (of the picture itself, or of one rendered at lower resolution),
/// then interpolation. `depthTolerance` as in Reconstruction.
std::unique_ptr<SparseSampling> makeSampling(frame::Frame& frame, const UniformSamplingSettings& settings,
                                             double depthTolerance, const ChosenEntry& inner);
/// The fewer pixels the wider a penumbra on screen, with the map and bias of the inner technique, then
/// pull-push.
std::unique_ptr<SparseSampling> makeSampling(frame::Frame& frame, const AdaptiveSamplingSettings& settings,
                                             double depthTolerance, const ChosenEntry& inner);

}  // namespace limen::techniques
