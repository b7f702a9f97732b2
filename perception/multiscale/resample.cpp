// SPDX-License-Identifier: BSD-3-Clause
#include "perception/multiscale/resample.h"

#include <algorithm>
#include <cassert>

namespace limen::perception {
namespace {

AxisTaps emptyTaps(int outputs, int taps) {
  AxisTaps out;
  out.outputs = outputs;
  out.taps = taps;
  const auto count = static_cast<size_t>(outputs) * static_cast<size_t>(taps);
  out.index.assign(count, 0);
  out.weight.assign(count, 0.0);
  return out;
}

/// Sets tap `tap` of `output`.
void setTap(AxisTaps& taps, int output, int tap, int index, double weight) {
  const auto at = static_cast<size_t>(output) * static_cast<size_t>(taps.taps) + static_cast<size_t>(tap);
  taps.index[at] = index;
  taps.weight[at] = weight;
}

/// Three tents of a bilinear sampler at `position` - 5/3, 0, + 5/3 texels, their weights as in the thesis.
void setNineFetch(AxisTaps& taps, int output, double position, int size, Border border) {
  // Pairs (1, 5), (10, 10), (5, 1) of 32: each fetch falls between its two texels in proportion.
  constexpr double kOffset = 5.0 / 3.0;
  constexpr std::array<double, 3> kWeight{6.0 / 32.0, 20.0 / 32.0, 6.0 / 32.0};
  for (int fetch = 0; fetch < 3; ++fetch) {
    const double at = position + (fetch - 1) * kOffset;
    const int left = static_cast<int>(std::floor(at));
    const double t = at - left;
    const double weight = kWeight[static_cast<size_t>(fetch)];
    setTap(taps, output, 2 * fetch, borderIndex(left, size, border), weight * (1.0 - t));
    setTap(taps, output, 2 * fetch + 1, borderIndex(left + 1, size, border), weight * t);
  }
}

Kernel fiveTaps(double outer, double inner, double centre, bool fused) {
  Kernel kernel;
  kernel.taps = {outer, inner, centre, inner, outer};
  kernel.fused = fused;
  return kernel;
}

}  // namespace

int borderIndex(int index, int size, Border border) {
  if (border == Border::Clamp) return std::clamp(index, 0, size - 1);
  const int period = 2 * size;
  const int folded = ((index % period) + period) % period;
  return folded < size ? folded : period - 1 - folded;
}

Kernel Kernel::binomial5() { return fiveTaps(1.0 / 16.0, 4.0 / 16.0, 6.0 / 16.0, false); }
Kernel Kernel::fused6() { return fiveTaps(1.0 / 16.0, 4.0 / 16.0, 6.0 / 16.0, true); }
Kernel Kernel::nineFetch6() {
  Kernel kernel = fused6();
  kernel.nineFetch = true;
  return kernel;
}
Kernel Kernel::burt5(double a) { return fiveTaps(0.25 - 0.5 * a, 0.25, a, false); }
Kernel Kernel::burt6(double a) { return fiveTaps(0.25 - 0.5 * a, 0.25, a, true); }

double Kernel::variancePx2() const {
  // Variances of convolved kernels add; two halves half a pixel off the centre make 1/4.
  return 2.0 * (4.0 * taps[0] + taps[1]) + (fused ? 0.25 : 0.0);
}

double Kernel::transfer(double w) const {
  const double five = taps[2] + 2.0 * (taps[1] * std::cos(w) + taps[0] * std::cos(2.0 * w));
  return fused ? five * std::cos(0.5 * w) : five;
}

int halved(int size) { return std::max(1, size / 2); }

AxisTaps reductionTaps(int size, const Kernel& kernel, Border border) {
  const int outputs = halved(size);
  if (!kernel.fused) {
    AxisTaps out = emptyTaps(outputs, 5);
    for (int x = 0; x < outputs; ++x)
      for (int tap = 0; tap < 5; ++tap)
        setTap(out, x, tap, borderIndex(2 * x + tap - 2, size, border),
               kernel.taps[static_cast<size_t>(tap)]);
    return out;
  }
  AxisTaps out = emptyTaps(outputs, 6);
  for (int x = 0; x < outputs; ++x) {
    // In pixel centres: the position of the coarse pixel's centre among the fine ones.
    const double position = (x + 0.5) * size / outputs - 0.5;
    if (kernel.nineFetch) {
      setNineFetch(out, x, position, size, border);
      continue;
    }
    const int left = static_cast<int>(std::floor(position));
    const double t = position - left;
    for (int tap = 0; tap < 6; ++tap) {
      const double here = tap < 5 ? kernel.taps[static_cast<size_t>(tap)] : 0.0;
      const double before = tap > 0 ? kernel.taps[static_cast<size_t>(tap - 1)] : 0.0;
      setTap(out, x, tap, borderIndex(left + tap - 2, size, border), (1.0 - t) * here + t * before);
    }
  }
  return out;
}

AxisTaps bilinearTaps(int from, int to, bool cosited, int levels, Border border) {
  AxisTaps out = emptyTaps(to, 2);
  const double scale = cosited ? std::ldexp(1.0, -levels) : static_cast<double>(from) / to;
  for (int x = 0; x < to; ++x) {
    const double position = cosited ? x * scale : (x + 0.5) * scale - 0.5;
    const int left = static_cast<int>(std::floor(position));
    const double t = position - left;
    setTap(out, x, 0, borderIndex(left, from, border), 1.0 - t);
    setTap(out, x, 1, borderIndex(left + 1, from, border), t);
  }
  return out;
}

AxisTaps expansionTaps(int from, int to, const Kernel& kernel, Border border) {
  // Fine sample x gets from coarse sample m the weight that m gets from x when reducing, doubled. The grid is
  // taken as exactly 2:1; the last pixel of an odd size sees the edge sample.
  const std::array<double, 5>& b = kernel.taps;
  AxisTaps out = emptyTaps(to, 3);
  for (int x = 0; x < to; ++x) {
    const int m = x / 2;
    const bool odd = x % 2 != 0;
    std::array<double, 3> weight{};  // of m - 1, m, m + 1
    if (kernel.fused) {
      const double outer = 0.5 * b[0], middle = 0.5 * (b[0] + b[1]), inner = 0.5 * (b[1] + b[2]);
      weight = {2.0 * (odd ? outer : middle), 2.0 * inner, 2.0 * (odd ? middle : outer)};
    } else {
      weight = {odd ? 0.0 : 2.0 * b[0], 2.0 * (odd ? b[1] : b[2]), 2.0 * (odd ? b[1] : b[0])};
    }
    // Kernels whose even and odd taps weigh differently would leave a pattern; each phase is made to sum
    // to 1.
    const double sum = weight[0] + weight[1] + weight[2];
    for (int tap = 0; tap < 3; ++tap)
      setTap(out, x, tap, borderIndex(m + tap - 1, from, border), weight[static_cast<size_t>(tap)] / sum);
  }
  return out;
}

AxisTaps gaussianTaps(int size, double sigmaPx, Border border) {
  const int radius = static_cast<int>(std::ceil(6.0 * sigmaPx));
  AxisTaps out = emptyTaps(size, 2 * radius + 1);
  std::vector<double> weights;
  double sum = 0.0;
  for (int k = -radius; k <= radius; ++k) {
    weights.push_back(radius == 0 ? 1.0 : std::exp(-0.5 * (k / sigmaPx) * (k / sigmaPx)));
    sum += weights.back();
  }
  for (int x = 0; x < size; ++x)
    for (int k = -radius; k <= radius; ++k)
      setTap(out, x, k + radius, borderIndex(x + k, size, border),
             weights[static_cast<size_t>(k + radius)] / sum);
  return out;
}

AxisTaps boxTaps(int size, int sidePx, Border border) {
  AxisTaps out = emptyTaps(size, sidePx);
  for (int x = 0; x < size; ++x)
    for (int k = 0; k < sidePx; ++k)
      setTap(out, x, k, borderIndex(x + k - sidePx / 2, size, border), 1.0 / sidePx);
  return out;
}

AxisTaps dilatedTaps(int size, const Kernel& kernel, int dilation, Border border) {
  assert(!kernel.fused && "an even number of taps has no centre to dilate about");
  AxisTaps out = emptyTaps(size, 5);
  for (int x = 0; x < size; ++x)
    for (int tap = 0; tap < 5; ++tap)
      setTap(out, x, tap, borderIndex(x + (tap - 2) * dilation, size, border),
             kernel.taps[static_cast<size_t>(tap)]);
  return out;
}

Plane resample(const Plane& source, const AxisTaps& columns, const AxisTaps& rows) {
  Plane out(columns.outputs, rows.outputs);
  const auto width = static_cast<size_t>(source.width);
  const auto columnTaps = static_cast<size_t>(columns.taps), rowTaps = static_cast<size_t>(rows.taps);
  const size_t cost = width * rowTaps + static_cast<size_t>(out.width) * columnTaps;
  forRowBlocks(out.height, cost, [&](int first, int end) {
    std::vector<double> sums(width);
    for (int y = first; y < end; ++y) {
      for (size_t tap = 0; tap < rowTaps; ++tap) {
        const size_t at = static_cast<size_t>(y) * rowTaps + tap;
        const double weight = rows.weight[at];
        const double* from = source.row(rows.index[at]);
        if (tap == 0)
          for (size_t x = 0; x < width; ++x) sums[x] = weight * from[x];
        else if (weight != 0.0)
          for (size_t x = 0; x < width; ++x) sums[x] += weight * from[x];
      }
      double* to = out.row(y);
      const int* index = columns.index.data();
      const double* weight = columns.weight.data();
      for (int x = 0; x < out.width; ++x, index += columnTaps, weight += columnTaps) {
        double sum = 0.0;
        for (size_t tap = 0; tap < columnTaps; ++tap)
          sum += weight[tap] * sums[static_cast<size_t>(index[tap])];
        to[x] = sum;
      }
    }
  });
  return out;
}

}  // namespace limen::perception
