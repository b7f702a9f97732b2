// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/parameter.h"
#include "base/registry.h"
#include "renderer/gl/texture.h"

namespace limen::perception {

/// One pair of products to compare. All images have the same size. The textures are what the technique made; the
/// images are the same values read back (once, for all metrics of a run).
struct ComparisonInput {
  const gl::Texture* testTexture = nullptr;       ///< R32F or RGBA32F; null where no GL context exists
  const gl::Texture* referenceTexture = nullptr;  ///< same format
  const Image* test = nullptr;                    ///< 1 (visibility) or 3..4 channels (linear RGB)
  const Image* reference = nullptr;
  /// 1 where the product means something (receivers), 0 elsewhere; 1 channel. Null: everywhere.
  const Image* mask = nullptr;
};

struct MetricResult {
  double value = 0.0;
  /// Per-pixel map (1 channel, larger is worse), where the metric has one.
  std::optional<Image> map;
  std::string mapName;  ///< "absolute_error", "flip", ...
};

/// Registration of a metric: `compare` judges a test product against a reference.
struct MetricInfo {
  static constexpr const char* kKind = "metric";
  std::string name;
  int version = 1;
  std::string summary;
  std::string source;
  std::string unit;
  bool higherIsBetter = false;
  bool needsGl = false;
  bool needsReference = true;  ///< false: judges the test product alone (non-finite count)
  std::vector<Parameter> parameters;
  std::function<MetricResult(const ComparisonInput&, const ParameterValues&)> compare;
};
using MetricRegistry = Registry<MetricInfo>;

}  // namespace limen::perception
