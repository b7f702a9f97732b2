// SPDX-License-Identifier: BSD-3-Clause
#include "perception/metrics/color_video_vdp/pyramid.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "perception/metrics/color_video_vdp/parameters.h"

namespace limen::perception::cvvdp {
namespace {

constexpr std::array<double, 5> kKernel = {0.05, 0.25, 0.4, 0.25, 0.05};

/// Half-sample symmetric: -1 is 0, n is n - 1.
int symmetric(int i, int n) {
  if (i < 0) i = -i - 1;
  if (i >= n) i = 2 * n - 1 - i;
  return std::clamp(i, 0, n - 1);
}

/// Mirrored about the border samples: -1 is 1, n is n - 2.
int reflected(int i, int n) {
  if (i < 0) i = -i;
  return i >= n ? 2 * n - 2 - i : i;
}

}  // namespace

std::vector<double> bandFrequenciesCpd(int width, int height, double pixelsPerDegree) {
  const Parameters& p = parameters();
  const double nyquist = 0.5 * pixelsPerDegree;
  std::vector<double> out = {nyquist};
  while (out.back() > p.leastFrequencyCpd)
    out.push_back(p.secondBandFrequency * std::exp2(-static_cast<double>(out.size() - 1)) * nyquist);
  const int lastByFrequency = static_cast<int>(out.size());
  int lastBySize = -1;
  for (int side = std::min(width, height); side > 1; side /= 2) ++lastBySize;
  const int last = std::max(std::min(lastByFrequency, lastBySize), 0);
  out.resize(static_cast<size_t>(last) + 1);
  out.back() = p.baseFrequencyCpd;
  return out;
}

double bandMultiplier(int band, int bands) { return band == 0 || band == bands - 1 ? 1.0 : 2.0; }

Plane reduce(const Plane& fine, bool referenceBorders) {
  const int width = (fine.width + 1) / 2, height = (fine.height + 1) / 2;
  Plane down(fine.width, height), out(width, height);
  forRowBlocks(height, 5 * static_cast<size_t>(fine.width), [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < fine.width; ++x) {
        double sum = 0.0;
        for (int k = -2; k <= 2; ++k)
          sum += kKernel[static_cast<size_t>(k + 2)] * fine.at(x, symmetric(2 * y + k, fine.height));
        down.at(x, y) = sum;
      }
  });
  forRowBlocks(height, 5 * static_cast<size_t>(width), [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < width; ++x) {
        double sum = 0.0;
        for (int k = -2; k <= 2; ++k) {
          const int i = 2 * x + k;
          if (referenceBorders && i >= fine.width) continue;  // nothing there, corrected below
          sum += kKernel[static_cast<size_t>(k + 2)] * down.at(symmetric(i, fine.width), y);
        }
        if (referenceBorders && x == width - 1) {
          const double last = down.at(fine.width - 1, y), before = down.at(std::max(fine.width - 2, 0), y);
          sum += fine.height % 2 == 1 ? kKernel[3] * last + kKernel[4] * before : kKernel[4] * last;
        }
        out.at(x, y) = sum;
      }
  });
  return out;
}

namespace {

/// Sample i of a row or column expanded from `count` samples.
template <class At>
double expanded(int i, int count, const At& at) {
  const auto clamped = [&](int s) { return at(std::clamp(s, 0, count - 1)); };
  const int s = i / 2;
  if (i % 2 == 0) return 2.0 * (0.05 * clamped(s - 1) + 0.4 * clamped(s) + 0.05 * clamped(s + 1));
  return 2.0 * (0.25 * clamped(s) + 0.25 * clamped(s + 1));
}

}  // namespace

Plane expand(const Plane& coarse, int width, int height) {
  Plane tall(coarse.width, height), out(width, height);
  forRowBlocks(height, 3 * static_cast<size_t>(width), [&](int first, int end) {
    for (int y = first; y < end; ++y) {
      for (int x = 0; x < coarse.width; ++x)
        tall.at(x, y) = expanded(y, coarse.height, [&](int i) { return coarse.at(x, i); });
      for (int x = 0; x < width; ++x)
        out.at(x, y) = expanded(x, coarse.width, [&](int i) { return tall.at(i, y); });
    }
  });
  return out;
}

Plane blurMasker(const Plane& plane) {
  const Parameters& p = parameters();
  const int radius = p.blurRadius;
  if (plane.width <= radius || plane.height <= radius) return plane;
  std::vector<double> taps;
  double sum = 0.0;
  for (int i = -radius; i <= radius; ++i) {
    taps.push_back(std::exp(-i * i / (2.0 * p.blurSigma * p.blurSigma)));
    sum += taps.back();
  }
  Plane across(plane.width, plane.height), out(plane.width, plane.height);
  const size_t cost = taps.size() * static_cast<size_t>(plane.width);
  forRowBlocks(plane.height, cost, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < plane.width; ++x) {
        double value = 0.0;
        for (int i = -radius; i <= radius; ++i)
          value += taps[static_cast<size_t>(i + radius)] / sum * plane.at(reflected(x + i, plane.width), y);
        across.at(x, y) = value;
      }
  });
  forRowBlocks(plane.height, cost, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < plane.width; ++x) {
        double value = 0.0;
        for (int i = -radius; i <= radius; ++i)
          value += taps[static_cast<size_t>(i + radius)] / sum * across.at(x, reflected(y + i, plane.height));
        out.at(x, y) = value;
      }
  });
  return out;
}

}  // namespace limen::perception::cvvdp
