// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "perception/command/figures.h"
#include "perception/command/image_input.h"
#include "perception/command/settings_text.h"

namespace limen::perception {

/// Metrics that `compare` runs if none are named: those that evaluate any image.
std::vector<std::string> defaultMetrics();
/// Groups of the parameters of these metrics, for --set. flip's pixels_per_degree is the display's unless
/// set. Throws Error on an unknown metric.
std::vector<SettingsGroup> metricSettings(const std::vector<std::string>& names,
                                          const DisplayProfile& display);

struct MetricMap {
  std::string name;  ///< "absolute_error", "flip"
  Image map;
};

/// Runs registered metrics on pairs of images, in light relative to the display's white.
class ImageMetrics {
 public:
  /// `values`: one for each name.
  ImageMetrics(std::vector<std::string> names, std::vector<ParameterValues> values);
  ~ImageMetrics();
  ImageMetrics(const ImageMetrics&) = delete;
  ImageMetrics& operator=(const ImageMetrics&) = delete;

  /// What run() returns, without values.
  Figures declared() const;
  /// Figures of the metrics, then rmse_coded and equivalents: the same on coded values, if both images are
  /// coded. A non-finite reference value counts as what the display shows for it; one of the test is treated
  /// by the metrics' own rule. `maps` (may be null) receives each map once.
  Figures run(const InputImage& test, const InputImage& reference, std::vector<MetricMap>* maps);
  /// Name, version and device of each metric, for the result.
  nlohmann::json facts() const;

 private:
  struct Gpu;
  struct Entry;

  /// Makes the OpenGL context at the first call; null, with the reason recorded, if there is none.
  Gpu* gpu();

  std::vector<Entry> entries_;
  std::unique_ptr<Gpu> gpu_;
  std::string noGpu_;
};

}  // namespace limen::perception
