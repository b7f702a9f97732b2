// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>

#include "renderer/gl/context.h"

namespace limen::perception {

/// What metrics that run on the GPU share: the context, and objects kept between calls so that comparing
/// allocates and compiles nothing. Destroyed before the context.
class MetricGpu {
 public:
  explicit MetricGpu(gl::Context& context) : context_(context) {}
  MetricGpu(const MetricGpu&) = delete;
  MetricGpu& operator=(const MetricGpu&) = delete;

  gl::Context& context() { return context_; }
  /// Objects kept by the metric of that name; initially null. Only that metric knows their type.
  std::shared_ptr<void>& kept(const std::string& metric) { return kept_[metric]; }

 private:
  gl::Context& context_;
  std::map<std::string, std::shared_ptr<void>> kept_;
};

}  // namespace limen::perception
