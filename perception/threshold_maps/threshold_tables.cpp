// SPDX-License-Identifier: BSD-3-Clause
#include "perception/threshold_maps/threshold_tables.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <map>

#include "perception/threshold_maps/threshold_map_bindings.h"
#include "perception/vision/castle_csf.h"

namespace limen::perception {
namespace {

constexpr double kLgLow = -4.0;
constexpr int kCellsPerDecade = 250;

/// floor((x + 1/2) from / to - 1/2), exactly.
int placeOf(int x, int from, int to) {
  const int64_t n = (2 * int64_t{x} + 1) * from - to, d = 2 * int64_t{to};
  return static_cast<int>(n >= 0 ? n / d : -((-n + d - 1) / d));
}

}  // namespace

std::vector<glm::vec4> thresholdTables(const ThresholdModel& model) {
  const auto stride = static_cast<size_t>(model.bands()) + 1;
  const bool kinked = model.hasCastleKink();
  const int cells = kThresholdCells + (kinked ? kThresholdKinkCells : 0);
  const double kink = castleKinkCdM2();
  std::vector<glm::vec4> out(stride * static_cast<size_t>(cells));
  // Luminance at a place between the cell's ends, 0 to 1; just inside it, on the correct side of a step.
  const auto luminance = [&](int cell, double place) {
    constexpr double kInside = 1e-9;
    if (cell < kThresholdCells)
      return std::pow(10.0, kLgLow + (cell + place) / kCellsPerDecade + (place < 0.5 ? kInside : -kInside));
    const double power = (cell - kThresholdCells + place) / kThresholdKinkCells;
    return kink + (kKinkEndCdM2 - kink) * std::pow(power, 1.0 / kCastleKinkExponent);
  };
  const double kinkPlace = (std::log10(kink) - kLgLow) * kCellsPerDecade;
  forRowBlocks(cells, 20000, [&](int first, int end) {
    for (int cell = first; cell < end; ++cell) {
      const bool hasKink = kinked && cell == static_cast<int>(kinkPlace);
      const double low = luminance(cell, 0.0), high = hasKink ? kink : luminance(cell, 1.0);
      glm::vec4* row = &out[stride * static_cast<size_t>(cell)];
      const double peakLow = model.peakSensitivity(low), peakHigh = model.peakSensitivity(high);
      row[0] = {model.tviCdM2(low), model.tviCdM2(high), peakLow, peakHigh};
      for (int band = 0; band < model.bands(); ++band)
        row[1 + band] = {model.sensitivity(band, low), model.sensitivity(band, high),
                         model.frequencyElevation(band, low, peakLow),
                         model.frequencyElevation(band, high, peakHigh)};
      if (!hasKink) continue;
      // Only what lies below the kink is read here: its line, drawn on to the cell's end.
      const auto drawOn = [&](float from, float& to) {
        to = from + (to - from) / static_cast<float>(kinkPlace - cell);
      };
      for (glm::vec4* entry = row; entry < row + stride; ++entry)
        drawOn(entry->x, entry->y), drawOn(entry->z, entry->w);
    }
  });
  return out;
}

std::vector<glm::vec2> elevationTable(const ThresholdModel& model) {
  constexpr int kSegments = 32, kLowOctave = -20, kOctaves = 64;
  std::vector<glm::vec2> out(static_cast<size_t>(kSegments) * kOctaves);
  for (int i = 0; i < kSegments * kOctaves; ++i) {
    const auto value = [&](int place) {
      const double c = std::ldexp(1.0 + static_cast<double>(place) / kSegments, kLowOctave + i / kSegments);
      return model.maskingElevation(c);
    };
    const double start = value(i % kSegments), end = value(i % kSegments + 1);
    out[static_cast<size_t>(i)] = {start, end - start};
  }
  return out;
}

LevelPlaces levelPlaces(glm::ivec2 sizePx, int levels) {
  LevelPlaces out;
  const auto append = [&](int from, int to) {
    const int start = static_cast<int>(out.places.size());
    for (int x = 0; x < to; ++x) {
      const int left = placeOf(x, from, to);
      const int64_t rest = (2 * int64_t{x} + 1) * from - to - int64_t{left} * 2 * to;
      out.places.emplace_back(left, static_cast<double>(rest) / (2.0 * to));
    }
    return start;
  };
  for (int level = 0; level + 1 < levels; ++level) {
    const glm::ivec2 coarser(halved(sizePx.x), halved(sizePx.y));
    const int columns = append(coarser.x, sizePx.x), rows = append(coarser.y, sizePx.y);
    out.upward.emplace_back(columns, rows);
    const int coarserColumns = append(sizePx.x, coarser.x), coarserRows = append(sizePx.y, coarser.y);
    out.downward.emplace_back(coarserColumns, coarserRows);
    sizePx = coarser;
  }
  return out;
}

std::vector<glm::vec4> levelTaps(int size, int levels, bool direct) {
  std::vector<glm::vec4> out;
  std::vector<int> sizes{size};
  for (int level = 1; level < levels; ++level) sizes.push_back(halved(sizes.back()));
  for (int level = 1; level < levels; ++level)
    for (int x = 0; x < size; ++x) {
      // Weights of samples of one level, which are passed on to the next coarser one.
      std::map<int, double> weights{{x, 1.0}};
      for (int at = direct ? level : 1; at <= level; ++at) {
        const int fine = sizes[direct ? 0 : static_cast<size_t>(at) - 1],
                  coarse = sizes[static_cast<size_t>(at)];
        std::map<int, double> next;
        for (const auto& [sample, weight] : weights) {
          const int left = placeOf(sample, coarse, fine);
          const double t = (sample + 0.5) * coarse / fine - 0.5 - left;
          next[std::clamp(left, 0, coarse - 1)] += weight * (1.0 - t);
          next[std::clamp(left + 1, 0, coarse - 1)] += weight * t;
        }
        weights = std::move(next);
      }
      const int first = weights.begin()->first;
      assert(weights.rbegin()->first <= first + 2);
      out.emplace_back(first, weights.begin()->second, weights.count(first + 2) ? weights.at(first + 2) : 0.0,
                       0.0);
    }
  return out;
}

std::vector<glm::ivec2> tilePatches(const std::vector<glm::vec4>& taps, int size, int tilePx, int levels) {
  std::vector<glm::ivec2> out;
  for (int start = 0; start < size; start += tilePx)
    for (int level = 1; level < levels; ++level) {
      const auto begin = taps.begin() + int64_t{level - 1} * size + start;
      const auto end = begin + std::min(tilePx, size - start);
      const auto [least, most] =
          std::minmax_element(begin, end, [](const glm::vec4& a, const glm::vec4& b) { return a.x < b.x; });
      out.emplace_back(static_cast<int>(least->x), static_cast<int>(most->x - least->x) + 3);
    }
  return out;
}

}  // namespace limen::perception
