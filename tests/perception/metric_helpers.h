// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <random>
#include <string>
#include <vector>

#include "perception/metrics/metric.h"

namespace limen::perception {

inline Image makeImage(int width, int height, int channels, const std::vector<float>& values) {
  Image image(width, height, channels);
  image.data = values;
  return image;
}

/// Uniform in [0, 1), the same on every machine.
inline Image randomImage(int width, int height, int channels, unsigned seed) {
  std::mt19937 random(seed);
  Image image(width, height, channels);
  for (float& value : image.data) value = static_cast<float>(random() >> 8) * 0x1p-24F;
  return image;
}

inline MetricResult measure(const std::string& metric, const ComparisonInput& input,
                            const std::map<std::string, ParameterValue>& given = {}) {
  const MetricInfo& info = MetricRegistry::instance().get(metric);
  return info.compare(input, ParameterValues(info.parameters, given));
}

inline ComparisonInput pairOf(const Image& test, const Image& reference, const Image* mask = nullptr) {
  ComparisonInput input;
  input.test = &test;
  input.reference = &reference;
  input.mask = mask;
  return input;
}

inline double valueOf(const std::string& metric, const Image& test, const Image& reference,
                      const std::map<std::string, ParameterValue>& given = {}) {
  return measure(metric, pairOf(test, reference), given).value;
}

}  // namespace limen::perception
