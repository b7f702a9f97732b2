// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/many_lods/sky.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace limen::techniques {
namespace {

constexpr int kSkyRows = 256, kSkyColumns = 512;  // of the table that lights are drawn from

glm::dvec3 skyDirection(double height, double turn) {
  const double across = std::sqrt(std::max(1.0 - height * height, 0.0));
  return {across * std::cos(turn), height, across * std::sin(turn)};
}

/// Where a share of the whole lies: cell and place in it, of sums that end with the whole.
struct SkyPlace {
  int cell;
  double within;
};
SkyPlace placeOf(const std::vector<double>& sums, double share) {
  const double at = share * sums.back();
  const auto found = std::upper_bound(sums.begin(), sums.end(), at);
  const auto cell = std::min<ptrdiff_t>(found - sums.begin(), static_cast<ptrdiff_t>(sums.size()) - 1);
  const double before = cell > 0 ? sums[size_t(cell) - 1] : 0.0, here = sums[size_t(cell)] - before;
  return {static_cast<int>(cell), here > 0.0 ? std::clamp((at - before) / here, 0.0, 1.0) : 0.5};
}

}  // namespace

const SettingsTable<SkySettings>& SkySettings::table() {
  using S = SkySettings;
  constexpr Range kRadiances{0.0, 10000.0};
  static const SettingsTable<S> kTable = {
      {&S::zenith, "zenith", kRadiances, "W/(m^2 sr)", "Radiance of the zenith"},
      {&S::horizon, "horizon", kRadiances, "W/(m^2 sr)", "Radiance above the horizon"},
      {&S::ground, "ground", kRadiances, "W/(m^2 sr)", "Radiance below the horizon"},
      {&S::sun, "sun", kRadiances, "W/(m^2 sr)", "Radiance that the middle of the sun adds"},
      {&S::sunWidthDeg, "sun_width", {0.5, 60.0}, "deg", "Angle at which it has fallen to exp(-1/2)"},
      {&S::sunElevationDeg, "sun_elevation", {-90.0, 90.0}, "deg", "Height of the sun above the horizon"},
      {&S::sunAzimuthDeg,
       "sun_azimuth",
       {-180.0, 180.0},
       "deg",
       "Its direction around the vertical axis, from x to z"}};
  return kTable;
}

glm::dvec3 SkySettings::sunDirection() const {
  return skyDirection(std::sin(glm::radians(sunElevationDeg)), glm::radians(sunAzimuthDeg));
}

double SkySettings::radiance(glm::dvec3 direction) const {
  const double width = glm::radians(sunWidthDeg);
  const double base = direction.y >= 0.0 ? horizon + (zenith - horizon) * direction.y : ground;
  return base + sun * std::exp((glm::dot(direction, sunDirection()) - 1.0) / (width * width));
}

void configureSky(const gl::Program& program, const SkySettings& sky) {
  const double width = glm::radians(sky.sunWidthDeg);
  program.set("skyLayers", glm::vec4(sky.zenith, sky.horizon, sky.ground, sky.sun));
  program.set("sunDirection", glm::vec3(sky.sunDirection()));
  program.set("sunSharpness", static_cast<float>(1.0 / (width * width)));
}

std::vector<SkyLight> skyLights(const SkySettings& sky, int count) {
  // Cells of equal solid angle.
  std::vector<double> rowSums(kSkyRows);
  std::vector<std::vector<double>> sums(kSkyRows, std::vector<double>(kSkyColumns));
  double total = 0.0;
  for (size_t row = 0; row < kSkyRows; ++row) {
    double sum = 0.0;
    for (size_t column = 0; column < kSkyColumns; ++column)
      sums[row][column] = sum +=
          sky.radiance(skyDirection(2.0 * (double(row) + 0.5) / kSkyRows - 1.0,
                                    2.0 * std::numbers::pi * (double(column) + 0.5) / kSkyColumns));
    rowSums[row] = total += sum;
  }
  std::vector<SkyLight> out;
  if (!(total > 0.0)) return std::vector<SkyLight>(static_cast<size_t>(count));
  constexpr double kCell = 4.0 * std::numbers::pi / (kSkyRows * kSkyColumns);  // sr
  for (int i = 0; i < count; ++i) {
    const double u = 0.5 + i * 0.7548776662466927, v = 0.5 + i * 0.5698402909980532;  // R2
    const SkyPlace row = placeOf(rowSums, u - std::floor(u));
    const std::vector<double>& cells = sums[size_t(row.cell)];
    const SkyPlace column = placeOf(cells, v - std::floor(v));
    const double here = cells[size_t(column.cell)] - (column.cell > 0 ? cells[size_t(column.cell) - 1] : 0.0);
    const glm::dvec3 direction =
        skyDirection(2.0 * (row.cell + row.within) / kSkyRows - 1.0,
                     2.0 * std::numbers::pi * (column.cell + column.within) / kSkyColumns);
    const double density = here / total / kCell;
    out.push_back({direction, density > 0.0 ? sky.radiance(direction) / (density * count) : 0.0});
  }
  return out;
}

}  // namespace limen::techniques
