// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "perception/metrics/jnd/jnd_settings.h"
#include "perception/metrics/path.h"
#include "perception/popping/popping_gpu.h"

namespace limen::perception {

/// What a JND metric says of one pair of pictures.
struct JndFigures {
  double medianJnd = 0.0, p95Jnd = 0.0, largestJnd = 0.0;  ///< over the evaluated pixels, nearest rank
  double shareAbove1 = 0.0;                                ///< of them with at least 1 JND
  /// Highest of all regions of the picture; without one, 1 less than that of a single pixel at the threshold
  /// of regions.
  double rating = 0.0;
  double detection = 0.0;  ///< probability for that rating; the guess rate without a region
  int64_t evaluatedPixels = 0;
};

/// The visible difference between products, on the GPU: both as shown on a display (shown.glsl), compared by
/// the popping predictor, and the figures of its map. Makes everything once, for one image size; run() and
/// runStep() neither allocate nor read back.
class JndGpu {
 public:
  /// Throws Error like PoppingPredictorGpu.
  JndGpu(gl::Context& context, glm::ivec2 sizePx, const JndSettings& settings, double refreshHz = 0.0);

  /// The mask as a texture of this object's; null for none.
  const gl::Texture* upload(const Image* mask);

  /// Test and reference as they are, with nothing moving.
  void run(const PathFrame& pair, Depicts depicts);
  /// The change of a test from one frame of a path to the next, beyond the reference's (show.comp.glsl).
  void runStep(const PathFrame& before, const PathFrame& now, Depicts depicts);

  /// Of the last run; these wait for the GPU.
  JndFigures figures() const;
  Image readMap() const { return predictor_.jnd().read(); }
  RegionMap readRegions() const { return predictor_.readRegions(); }
  /// The pictures compared: 3 channels, light in [0, 1].
  Image readActual() const;
  Image readPredicted() const;

  glm::ivec2 sizePx() const { return sizePx_; }
  int64_t bytesHeld() const;

 private:
  void show(const gl::Program& program, const PathFrame& frame, Depicts depicts);
  void predict(const gl::Texture* displacement);

  gl::Context& context_;
  glm::ivec2 sizePx_;
  JndSettings settings_;
  PoppingPredictorGpu predictor_;
  gl::Texture actual_, predicted_, evaluated_, mask_;
  gl::Buffer statistics_;
};

/// The object for these settings and size, kept between calls.
JndGpu& keptJndGpu(MetricGpu& gpu, const std::string& metric, const std::string& settingsKey,
                   glm::ivec2 sizePx, const JndSettings& settings, double refreshHz = 0.0);

}  // namespace limen::perception
