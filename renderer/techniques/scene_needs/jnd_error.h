// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "perception/metrics/metric.h"
#include "perception/metrics/metric_gpu.h"
#include "renderer/frame/frame.h"
#include "renderer/techniques/scene_needs/error_estimate.h"
#include "renderer/techniques/scene_needs/target.h"

namespace limen::techniques {

/// Visible differences of products from the mean of two references, by the metric `jnd`, at the size at
/// which they are shown: unlike an RMSE, what is seen depends on a picture's size. The noise of the
/// references is part of what is seen. Waits for the GPU.
class JndErrors {
 public:
  /// `like`: the view. `truth` has its size.
  JndErrors(frame::Frame& like, const JndTarget& target, const ReferencePair& truth,
            perception::Depicts depicts);

  /// In JND. Sampling noise is half of noise(), as the mean of both references has half the variance of
  /// either and their difference has twice.
  ErrorEstimate estimate(const Image& product);
  /// What is seen between the two references.
  double noise() const { return noise_; }

 private:
  double between(const Image& test, const Image& reference);

  frame::Frame frame_;
  perception::MetricGpu gpu_;
  const perception::MetricInfo& metric_;
  ParameterValues settings_;
  size_t figure_ = 0;
  perception::Depicts depicts_;
  Image mask_, mean_;
  perception::LitSurfaces surfaces_;
  double noise_ = 0.0;
};

}  // namespace limen::techniques
