// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/cone_traced/contribution_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace limen::techniques {
namespace {

constexpr int kRings = 96;

/// Half the angle that the circle of radius r around 0 spends within a disk of `radius` around `distance`.
double halfArc(double r, double radius, double distance) {
  if (r + distance <= radius) return std::numbers::pi;
  if (r >= distance + radius || distance >= r + radius) return 0.0;
  return std::acos(
      std::clamp((r * r + distance * distance - radius * radius) / (2.0 * r * distance), -1.0, 1.0));
}

/// Area and weight of the part of a disk that lies within the cone, by rings around the cone's axis.
struct Part {
  double area = 0.0, weight = 0.0;
};
Part partOfCone(double radius, double distance, double wide) {
  const double first = std::max(distance - radius, 0.0), last = std::min(distance + radius, 1.0);
  Part out;
  for (int i = 0; i < kRings; ++i) {
    const double r = first + (last - first) * (i + 0.5) / kRings;
    const double area = 2.0 * halfArc(r, radius, distance) * r * (last - first) / kRings;
    out.area += area;
    out.weight += area * coneWeight(r, wide);
  }
  return out;
}

}  // namespace

double coneWeight(double distance, double wide) {
  // What two disks, of the reflection and of the lobe, have in common, relative to the smaller one.
  const double a = std::max(wide, 1.0 - wide), b = std::min(wide, 1.0 - wide);
  if (distance <= a - b) return 1.0;
  if (distance >= a + b || b <= 0.0) return b <= 0.0 && distance <= a ? 1.0 : 0.0;
  const auto segment = [](double radius, double chord) {
    const double cosine = std::clamp(chord / radius, -1.0, 1.0);
    return radius * radius * (std::acos(cosine) - cosine * std::sqrt(1.0 - cosine * cosine));
  };
  const double chord = (distance * distance + a * a - b * b) / (2.0 * distance);
  return (segment(a, chord) + segment(b, distance - chord)) / (std::numbers::pi * b * b);
}

double coneContribution(double share, double distance, double wide) {
  const Part whole = partOfCone(1.0, 0.0, wide);
  if (!(share > 0.0)) return 0.0;
  const Part part = partOfCone(std::sqrt(std::min(share, 1.0)), std::clamp(distance, 0.0, 1.0), wide);
  if (!(part.area > 0.0)) return 0.0;
  return share * (part.weight / part.area) / (whole.weight / whole.area);
}

std::vector<float> contributionTable(int side, double wide) {
  std::vector<float> out;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      out.push_back(static_cast<float>(coneContribution(x / (side - 1.0), y / (side - 1.0), wide)));
  return out;
}

}  // namespace limen::techniques
