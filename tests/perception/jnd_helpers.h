// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>

#include "perception/metrics/metric_gpu.h"
#include "perception/popping/predictor.h"

namespace limen::perception {

/// Order in which the JND metrics state their figures; the last only with changes.
enum { kP95, kMedian, kLargest, kShare, kRating, kDetection, kStep };
constexpr int kWidth = 96, kHeight = 70;

/// Tests of a metric on the GPU: one context for all of a program.
class JndTest : public testing::Test {
 protected:
  static gl::Context& context() {
    static const std::unique_ptr<gl::Context> shared = gl::createHeadlessContext();
    return *shared;
  }
  void SetUp() override { gpu_.emplace(context()); }
  void TearDown() override {
    gpu_.reset();
    EXPECT_NO_THROW(context().checkDebugMessages());
  }
  std::optional<MetricGpu> gpu_;
};

}  // namespace limen::perception
