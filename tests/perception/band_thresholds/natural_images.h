// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "perception/multiscale/plane.h"

/// Pictures with the statistics of natural ones, made from seeds. Luminances [cd/m2] in floats, so that the
/// GPU gets the same numbers.
namespace limen::perception {

inline double uniform(std::mt19937& random) { return static_cast<double>(random() >> 8) * 0x1p-24; }

/// Sum of octaves of value noise whose amplitude falls with frequency: a spectrum of about 1 / f. In [0, 1].
inline Plane fractalNoise(int width, int height, unsigned seed, double fallOff = 0.5) {
  Plane out(width, height);
  double sum = 0.0, amplitude = 1.0;
  for (int cell = 64; cell >= 1; cell /= 2, amplitude *= fallOff) {
    std::mt19937 random(seed * 101 + static_cast<unsigned>(cell));
    const int columns = width / cell + 2, rows = height / cell + 2;
    std::vector<double> nodes(static_cast<size_t>(columns) * static_cast<size_t>(rows));
    for (double& node : nodes) node = uniform(random);
    const auto node = [&](int x, int y) { return nodes[static_cast<size_t>(y * columns + x)]; };
    const auto smooth = [](double t) { return t * t * (3.0 - 2.0 * t); };
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const int i = x / cell, j = y / cell;
        const double s = smooth(static_cast<double>(x % cell) / cell),
                     t = smooth(static_cast<double>(y % cell) / cell);
        out.at(x, y) += amplitude * ((1.0 - t) * ((1.0 - s) * node(i, j) + s * node(i + 1, j)) +
                                     t * ((1.0 - s) * node(i, j + 1) + s * node(i + 1, j + 1)));
      }
    sum += amplitude;
  }
  for (double& value : out.data) value /= sum;
  return out;
}

/// Opaque discs of all sizes over each other, each with its grey and its own grain: edges, occlusion and
/// texture, as in photographs.
inline Plane deadLeaves(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  Plane out(width, height, 0.4);
  const Plane grain = fractalNoise(width, height, seed + 7, 0.8);
  for (int leaf = 0; leaf < 400; ++leaf) {
    // Radii with density r^-3, largest first in expectation no matter: later ones cover earlier ones.
    const double radius = std::min(4.0 / std::sqrt(1e-3 + uniform(random)), 0.4 * width);
    const double x0 = width * uniform(random), y0 = height * uniform(random), grey = uniform(random),
                 roughness = uniform(random) < 0.5 ? 0.0 : uniform(random);
    for (int y = std::max(0, static_cast<int>(y0 - radius)); y < std::min<double>(height, y0 + radius); ++y)
      for (int x = std::max(0, static_cast<int>(x0 - radius)); x < std::min<double>(width, x0 + radius); ++x)
        if (std::hypot(x - x0, y - y0) < radius)
          out.at(x, y) = grey * (1.0 + roughness * (2.0 * grain.at(x, y) - 1.0));
  }
  return out;
}

inline Plane bricks(int width, int height, unsigned seed) {
  const Plane grain = fractalNoise(width, height, seed, 0.9);
  Plane out(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int row = y / 14, column = (x + row % 2 * 16) / 32;
      const bool mortar = y % 14 < 2 || (x + row % 2 * 16) % 32 < 2;
      const double tone = 0.35 + 0.3 * (((row * 7 + column * 13) * 37 % 17) / 17.0);
      out.at(x, y) = (mortar ? 0.75 : tone) * (0.75 + 0.5 * grain.at(x, y));
    }
  return out;
}

/// A plane in perspective with a checkerboard, under light that falls off, with soft and hard shadows.
inline Plane room(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  const double lamp = uniform(random), edge = 0.3 + 0.4 * uniform(random);
  Plane out(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double u = (x + 0.5) / width, v = (y + 0.5) / height;
      double value = 0.5;
      if (v > 0.35) {
        const double depth = 1.0 / (v - 0.3);
        const int check =
            static_cast<int>(std::floor((u - 0.5) * depth * 6.0)) + static_cast<int>(std::floor(depth * 3.0));
        value = check % 2 != 0 ? 0.25 : 0.7;
      }
      value *= 1.0 / (1.0 + 4.0 * std::pow(std::hypot(u - lamp, v - 0.6), 2.0));
      value *= 1.0 - 0.7 * std::clamp((u - edge) * 8.0, 0.0, 1.0) * (v > 0.5 ? 1.0 : 0.0);
      if (std::hypot(u - 0.3, v - 0.55) < 0.12) value = 0.9 - 2.0 * (v - 0.45);
      out.at(x, y) = value;
    }
  return out;
}

constexpr int kNaturalImages = 20;

/// Image `index` of kNaturalImages on a display from `black` to `white`.
inline Plane naturalImage(int index, int width, int height, double black, double white) {
  const auto seed = static_cast<unsigned>(index + 1);
  Plane image;
  switch (index % 5) {
    case 0:
      image = fractalNoise(width, height, seed, index % 2 != 0 ? 0.5 : 0.75);
      break;
    case 1:
    case 2:
      image = deadLeaves(width, height, seed);
      break;
    case 3:
      image = bricks(width, height, seed);
      break;
    default:
      image = room(width, height, seed);
      break;
  }
  // Every fourth is dim.
  const double light = index % 4 == 3 ? 0.1 : 1.0;
  for (double& value : image.data)
    value = static_cast<float>(black + (white - black) * light * std::clamp(value, 0.0, 1.0));
  return image;
}

}  // namespace limen::perception
