// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <map>
#include <random>
#include <string>

#include "perception/multiscale/plane.h"
#include "perception/threshold_maps/settings.h"

namespace limen::perception {

/// Luminances [cd/m2] in floats, so that the GPU gets the same numbers.
inline Plane pattern(int width, int height, const std::function<double(int, int)>& value) {
  Plane out(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) out.at(x, y) = static_cast<float>(value(x, y));
  return out;
}

inline Plane noisePattern(int width, int height, unsigned seed = 1) {
  std::mt19937 random(seed);
  return pattern(width, height,
                 [&](int, int) { return 0.5 + 249.5 * static_cast<double>(random() >> 8) * 0x1p-24; });
}

/// Edges, fine and coarse texture, a gradient and dark parts: what renderings have.
inline Plane picture(int width, int height) {
  return pattern(width, height, [&](int x, int y) {
    const double u = (x + 0.5) / width, v = (y + 0.5) / height;
    double value = 60.0 * u + 5.0;
    if (v > 0.5) value *= 1.0 + 0.5 * std::sin(0.08 * x * (1.0 + 2.0 * u)) * std::cos(0.1 * y);
    if (u > 0.3 && u < 0.45 && v > 0.2) value = 180.0;
    if (u > 0.7 && v < 0.4) value = 0.6 + 2.0 * v;
    if (u > 0.8 && v > 0.6) value *= (x / 3 + y / 5) % 2 != 0 ? 0.25 : 1.5;
    return value;
  });
}

/// What is most likely to break a map.
inline std::map<std::string, Plane> adversarialPatterns() {
  std::map<std::string, Plane> out;
  out["black"] = pattern(64, 64, [](int, int) { return 0.0; });
  out["white"] = pattern(80, 64, [](int, int) { return 250.3; });
  out["single pixel"] = pattern(64, 64, [](int x, int y) { return x == 31 && y == 40 ? 200.0 : 0.0; });
  out["checkerboard"] = pattern(96, 64, [](int x, int y) { return (x + y) % 2 != 0 ? 250.0 : 0.5; });
  out["ramp"] = pattern(160, 90, [](int x, int) { return 1.0 + 0.7 * x; });
  out["faint ramp"] = pattern(128, 128, [](int x, int y) { return 80.0 + 0.003 * x + 0.001 * y; });
  out["row"] = pattern(333, 1, [](int x, int) { return x % 7 == 0 ? 100.0 : 3.0; });
  out["column"] = pattern(1, 190, [](int, int y) { return 10.0 + y; });
  out["pixel"] = pattern(1, 1, [](int, int) { return 42.0; });
  out["two by three"] = pattern(2, 3, [](int x, int y) { return 5.0 + 40.0 * x + y; });
  out["odd sizes"] = picture(101, 67);
  out["prime sizes"] = picture(211, 127);
  out["spikes"] = pattern(150, 100, [](int x, int y) { return (x * 7 + y * 13) % 97 == 0 ? 1e4 : 0.7; });
  out["spike in the dark"] = pattern(128, 128, [](int x, int y) { return x == 70 && y == 20 ? 1e4 : 0.01; });
  out["noise"] = noisePattern(130, 70);
  out["picture"] = picture(200, 150);
  return out;
}

inline ThresholdMapSettings settingsOf(const std::map<std::string, ParameterValue>& given = {}) {
  return ThresholdMapSettings::table().read(
      ParameterValues(ThresholdMapSettings::table().parameters(), given));
}

/// With the choices of Schwarz 2009 for what is not given.
inline ThresholdMapSettings thesisOf(std::map<std::string, ParameterValue> given = {}) {
  given["model"] = std::string("schwarz_2009");
  return settingsOf(given);
}

/// Pixels per degree of the thesis's study: pitch 0.255 mm at 60 cm.
inline constexpr double kStudyPpd = 41.07;

}  // namespace limen::perception
