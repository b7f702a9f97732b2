// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/lod/height_field.h"

#include <algorithm>
#include <cmath>

namespace limen::scene {
namespace {

/// Uniform in [-1, 1], computed from integers only (finaliser of MurmurHash3).
double latticeValue(int64_t i, int64_t j, int64_t octave, int64_t seed) {
  uint64_t h =
      static_cast<uint64_t>(i) * 0x9e3779b97f4a7c15U ^ static_cast<uint64_t>(j) * 0xc2b2ae3d27d4eb4fU ^
      static_cast<uint64_t>(octave) * 0x165667b19e3779f9U ^ static_cast<uint64_t>(seed) * 0xd6e8feb86659fd93U;
  h ^= h >> 33, h *= 0xff51afd7ed558ccdU, h ^= h >> 33, h *= 0xc4ceb9fe1a85ec53U, h ^= h >> 33;
  return static_cast<double>(h >> 11) * 0x1p-52 - 1.0;
}

double valueNoise(double x, double z, int64_t octave, int64_t seed) {
  const double fx = std::floor(x), fz = std::floor(z);
  const auto i = static_cast<int64_t>(fx), j = static_cast<int64_t>(fz);
  const auto ease = [](double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); };
  const double u = ease(x - fx), v = ease(z - fz);
  const auto row = [&](int64_t dj) {
    const double a = latticeValue(i, j + dj, octave, seed), b = latticeValue(i + 1, j + dj, octave, seed);
    return a + (b - a) * u;
  };
  const double a = row(0), b = row(1);
  return a + (b - a) * v;
}

}  // namespace

double HeightField::height(double x, double z) const {
  const auto place = [&](double t) { return std::clamp((t - low) / spacing, 0.0, double(side - 1)); };
  const double u = place(x), v = place(z);
  const int i = std::min(static_cast<int>(u), side - 2), j = std::min(static_cast<int>(v), side - 2);
  const double a = at(i, j) + (at(i + 1, j) - at(i, j)) * (u - i),
               b = at(i, j + 1) + (at(i + 1, j + 1) - at(i, j + 1)) * (u - i);
  return a + (b - a) * (v - j);
}

glm::dvec3 HeightField::normal(int i, int j) const {
  const int left = std::max(i - 1, 0), right = std::min(i + 1, side - 1);
  const int back = std::max(j - 1, 0), front = std::min(j + 1, side - 1);
  const double dx = (at(right, j) - at(left, j)) / (spacing * (right - left)),
               dz = (at(i, front) - at(i, back)) / (spacing * (front - back));
  return glm::normalize(glm::dvec3(-dx, 1.0, -dz));
}

double HeightField::highest() const { return *std::max_element(heights.begin(), heights.end()); }

HeightField mountains(const MountainSetting& setting) {
  HeightField out;
  out.side = setting.side;
  out.low = -0.5 * setting.size;
  out.spacing = setting.size / (setting.side - 1);
  double total = 0.0;
  for (int octave = 0; octave < setting.octaves; ++octave) total += std::exp2(-octave);
  for (int j = 0; j < setting.side; ++j)
    for (int i = 0; i < setting.side; ++i) {
      double sum = 0.0;
      for (int octave = 0; octave < setting.octaves; ++octave) {
        const double frequency = std::exp2(octave) / setting.feature;
        // Shifted so that octaves have no lattice line in common.
        const double x = (out.low + out.spacing * i) * frequency + 0.37 * octave,
                     z = (out.low + out.spacing * j) * frequency + 0.61 * octave;
        const double ridge = 1.0 - std::abs(valueNoise(x, z, octave, setting.seed));
        sum += std::exp2(-octave) * ridge * ridge;
      }
      out.heights.push_back(setting.relief * sum / total);
    }
  return out;
}

}  // namespace limen::scene
