// SPDX-License-Identifier: BSD-3-Clause
#include "perception/command/image_metrics.h"

#include <algorithm>
#include <cmath>

#include "experiments/base/error.h"
#include "perception/metrics/metric.h"
#include "perception/metrics/metric_gpu.h"
#include "renderer/gl/context.h"

namespace limen::perception {
namespace {

/// Metrics that are also meaningful on pixel values, where most publications compute them.
const std::vector<std::string>& codedMetrics() {
  static const std::vector<std::string> kNames = {"rmse", "mae", "largest_error", "psnr"};
  return kNames;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The reference with non-finite values replaced by what the display shows.
Image finite(const Image& image) {
  Image out = image;
  for (float& value : out.data)
    if (!std::isfinite(value)) value = value > 0.0F ? 1.0F : 0.0F;
  return out;
}

}  // namespace

struct ImageMetrics::Gpu {
  std::unique_ptr<gl::Context> context;
  MetricGpu metrics;
  explicit Gpu(std::unique_ptr<gl::Context> made) : context(std::move(made)), metrics(*context) {}
};

/// One figure: a metric with its parameters.
struct ImageMetrics::Entry {
  std::string figure;
  const MetricInfo* info = nullptr;
  ParameterValues values;
  bool coded = false;
};

std::vector<std::string> defaultMetrics() {
  // The other registered metrics evaluate visibility only.
  return {"rmse", "mae",  "signed_error", "largest_error", "p99_error",
          "psnr", "ssim", "de94",         "flip",          "non_finite"};
}

std::vector<SettingsGroup> metricSettings(const std::vector<std::string>& names,
                                          const DisplayProfile& display) {
  std::vector<SettingsGroup> groups;
  for (const std::string& name : names) {
    const MetricInfo& info = MetricRegistry::instance().get(name, "--metrics");
    groups.push_back({name, info.parameters});
    if (name != "flip") continue;
    for (Parameter& parameter : groups.back().parameters)
      if (parameter.name == "pixels_per_degree") {
        parameter.defaultValue =
            std::clamp(display.pixelsPerDegree(), *parameter.minimum, *parameter.maximum);
        parameter.description += " (default: the display's)";
      }
  }
  return groups;
}

ImageMetrics::ImageMetrics(std::vector<std::string> names, std::vector<ParameterValues> values) {
  for (size_t i = 0; i < names.size(); ++i) {
    const MetricInfo& info = MetricRegistry::instance().get(names[i], "--metrics");
    entries_.push_back({names[i], &info, values[i], false});
    // The mean says little of a small area; the largest difference is the popping predictor's comparator.
    std::map<std::string, ParameterValue> given = values[i].all();
    if (names[i] == "de94" && given.at("statistic") == ParameterValue("mean"))
      for (const char* statistic : {"p99", "max"}) {
        given["statistic"] = std::string(statistic);
        entries_.push_back({"de94_" + std::string(statistic), &info, {info.parameters, given}, false});
      }
  }
  for (size_t i = 0; i < names.size(); ++i)
    if (contains(codedMetrics(), names[i]))
      entries_.push_back({names[i] + "_coded", &MetricRegistry::instance().get(names[i]), values[i], true});
}

ImageMetrics::~ImageMetrics() = default;

ImageMetrics::Gpu* ImageMetrics::gpu() {
  if (gpu_ || !noGpu_.empty()) return gpu_.get();
  try {
    gpu_ = std::make_unique<Gpu>(gl::createHeadlessContext());
  } catch (const std::exception& error) {
    noGpu_ = std::string("no OpenGL context: ") + error.what();
  }
  return gpu_.get();
}

Figures ImageMetrics::declared() const {
  Figures figures;
  for (const Entry& entry : entries_) {
    std::string meaning = entry.info->summary;
    if (entry.coded) meaning += ", of coded values";
    figures.push_back({entry.figure,
                       entry.info->unit,
                       meaning,
                       entry.info->direction == Direction::HigherIsBetter,
                       {},
                       {}});
  }
  return figures;
}

Figures ImageMetrics::run(const InputImage& test, const InputImage& reference, std::vector<MetricMap>* maps) {
  const Image sound = finite(reference.linear);
  Figures figures = declared();
  for (size_t i = 0; i < entries_.size(); ++i) {
    const Entry& entry = entries_[i];
    Figure& figure = figures[i];
    ComparisonInput input;
    input.test = &test.linear;
    input.reference = &sound;
    if (entry.coded) {
      if (test.values.data.empty() || reference.values.data.empty()) {
        figure.reason = test.coded && reference.coded ? "half-covered pixels have no coded value"
                                                      : "the images do not both hold coded values";
        continue;
      }
      input.test = &test.values;
      input.reference = &reference.values;
    }
    if (entry.info->needsGl) {
      Gpu* const found = gpu();
      if (!found) {
        figure.reason = noGpu_;
        continue;
      }
      input.gpu = &found->metrics;
    }
    MetricResult result = entry.info->compare(input, entry.values);
    figure.value = result.value;
    if (!maps || !result.map || entry.coded) continue;
    const bool known = std::any_of(maps->begin(), maps->end(),
                                   [&](const MetricMap& map) { return map.name == result.mapName; });
    if (!known) maps->push_back({result.mapName, std::move(*result.map)});
  }
  return figures;
}

nlohmann::json ImageMetrics::facts() const {
  nlohmann::json versions = nlohmann::json::object();
  for (const Entry& entry : entries_) versions[entry.info->name] = entry.info->version;
  nlohmann::json out = {{"metric_versions", versions}};
  if (gpu_) out["opengl"] = gpu_->context->device().line();
  return out;
}

}  // namespace limen::perception
