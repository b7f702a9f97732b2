// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "perception/metrics/jnd/jnd_gpu.h"

namespace limen::perception {

/// What JND metrics declare; `of` begins their titles: "Visible difference".
std::vector<Quantity> jndQuantities(const std::string& of);
/// In the same order.
std::vector<double> jndValues(const JndFigures& figures);
/// Regions over the picture in grey, each in the colour of its rating.
MetricPicture regionPicture(const std::string& name, const Image& shown, const RegionMap& regions);
/// All settings as text, by which objects are kept.
template <class S>
std::string settingsKey(const S& settings) {
  std::string key;
  for (const auto& [path, value] : S::table().write(settings)) key += path + "=" + toText(value) + ";";
  return key;
}

/// Throws Error if the metric cannot show such a product.
void requireShown(const ComparisonInput& input, const std::string& metric);

}  // namespace limen::perception
