// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>

#include "renderer/gl/context.h"

namespace limen::perception {

/// What metrics that run on the GPU share: the context, and the objects that they keep from one call to the
/// next so that comparing allocates and compiles nothing. Dies before the context.
class MetricGpu {
 public:
  explicit MetricGpu(gl::Context& context) : context_(context) {}
  MetricGpu(const MetricGpu&) = delete;
  MetricGpu& operator=(const MetricGpu&) = delete;

  gl::Context& context() { return context_; }
  /// What the metric of that name keeps; null at first. Only that metric knows its type.
  std::shared_ptr<void>& kept(const std::string& metric) { return kept_[metric]; }

 private:
  gl::Context& context_;
  std::map<std::string, std::shared_ptr<void>> kept_;
};

}  // namespace limen::perception
