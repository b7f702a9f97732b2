// SPDX-License-Identifier: BSD-3-Clause
#include "perception/command/map_picture.h"

#include <cmath>
#include <vector>

#include "experiments/base/text.h"
#include "perception/metrics/error_map.h"
#include "perception/metrics/quantile.h"

namespace limen::perception {

double pictureScale(const Image& map) {
  std::vector<double> values;
  for (const float value : map.data)
    if (std::isfinite(value)) values.push_back(value);
  const double high = nearestRank(values, 0.99);
  return high > 0.0 ? errorScale(Image(1, 1, 1, static_cast<float>(high))) : errorScale(map);
}

std::string writeMapPicture(const std::string& path, const Image& map, double scale, const std::string& unit,
                            const std::string& description) {
  const std::string meaning =
      "black 0, pale yellow " + shortestNumber(scale) + (unit.empty() ? "" : " " + unit) + " and above";
  writePng(path, errorPicture(map, scale), meaning + "; " + description);
  return meaning;
}

}  // namespace limen::perception
