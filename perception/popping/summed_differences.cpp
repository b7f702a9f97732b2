// SPDX-License-Identifier: BSD-3-Clause
#include "perception/popping/summed_differences.h"

#include <algorithm>
#include <cmath>

#include "perception/metrics/row_sums.h"

namespace limen::perception {
namespace {

/// Two neighbours of a row or column of level 0 in a coarser level, and the second's weight.
struct Place {
  int first, second;
  double weight;
};
Place placeOf(int position, int level, int size) {
  const int block = 1 << level, first = position / block;
  return {std::min(first, size - 1), std::min(first + 1, size - 1),
          static_cast<double>(position % block) / block};
}

double weightAt(const PoppingInput& input, const PoppingSettings& settings, int x, int y) {
  double weight = 1.0;
  const auto apply = [&](const Image& map) {
    if (map.data.empty()) return;
    const double value = map.at(x, y);
    if (std::isfinite(value)) weight *= std::clamp(value, 0.0, 1.0);
  };
  if (settings.usesDisocclusion()) apply(input.disocclusion);
  if (settings.usesFlicker()) apply(input.flicker);
  return weight;
}

}  // namespace

SummedDifferences sumDifferences(const std::vector<std::array<Plane, 3>>& differences,
                                 const PoppingInput& input, const PoppingSettings& settings) {
  const int width = input.actual.width, height = input.actual.height;
  const bool isStack = settings.bands.isStack();
  const double exponent = settings.minkowskiExponent;
  const bool isSigned = settings.collapse == Collapse::Signed;
  std::vector<std::array<Plane, 3>> raised;
  if (!isSigned)
    for (const auto& level : differences) {
      raised.push_back(level);
      for (Plane& plane : raised.back())
        for (double& value : plane.data) value = std::pow(std::abs(value), exponent);
    }
  SummedDifferences out{Plane(width, height), Plane(width, height, 1.0), Plane(width, height),
                        Plane(width, height)};
  forRowBlocks(height, static_cast<size_t>(width) * 400, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < width; ++x) {
        double sum = 0.0, signedSum = 0.0;
        for (size_t i = 0; i < differences.size(); ++i) {
          const int level = isStack ? 0 : static_cast<int>(i);
          const std::array<Plane, 3>& own = differences[i];
          const Place column = placeOf(x, level, own[0].width), row = placeOf(y, level, own[0].height);
          const auto interpolate = [&](const Plane& plane) {
            if (level == 0 || isStack) return plane.at(x, y);
            const double above = (1.0 - column.weight) * plane.at(column.first, row.first) +
                                 column.weight * plane.at(column.second, row.first);
            const double below = (1.0 - column.weight) * plane.at(column.first, row.second) +
                                 column.weight * plane.at(column.second, row.second);
            return (1.0 - row.weight) * above + row.weight * below;
          };
          for (size_t c = 0; c < 3; ++c) {
            const double value = interpolate(own[c]);
            if (value == 0.0 && isSigned) continue;
            const double power = isSigned ? std::pow(std::abs(value), exponent) : interpolate(raised[i][c]);
            sum += power;
            signedSum += std::copysign(power, value);
          }
        }
        const double difference = sum > 0.0 ? std::pow(sum, 1.0 / exponent) : 0.0;
        const double w = weightAt(input, settings, x, y);
        out.jnd.at(x, y) = difference;
        out.signedJnd.at(x, y) =
            signedSum == 0.0 ? 0.0
                             : std::copysign(std::pow(std::abs(signedSum), 1.0 / exponent), signedSum) * w;
        out.weight.at(x, y) = w;
        out.weightedJnd.at(x, y) = difference * w;
      }
  });
  return out;
}

double meanOf(const Plane& plane) {
  const double sum = sumRows(plane.height, static_cast<size_t>(plane.width), [&](int y) {
    CompensatedSum row;
    for (int x = 0; x < plane.width; ++x) row.add(plane.at(x, y));
    return row.value();
  });
  return sum / static_cast<double>(plane.data.size());
}

}  // namespace limen::perception
