// SPDX-License-Identifier: BSD-3-Clause
#include "perception/multiscale/pyramid.h"

#include <algorithm>
#include <cassert>

namespace limen::perception {
namespace {

/// One level up, to a given size.
Plane upsampleOnce(const Plane& coarse, int width, int height, const PyramidSettings& settings) {
  const Kernel& kernel = settings.kernel;
  if (settings.upsampler == Upsampler::Expand)
    return resample(coarse, expansionTaps(coarse.width, width, kernel, settings.border),
                    expansionTaps(coarse.height, height, kernel, settings.border));
  return resample(coarse, bilinearTaps(coarse.width, width, !kernel.fused, 1, settings.border),
                  bilinearTaps(coarse.height, height, !kernel.fused, 1, settings.border));
}

Plane difference(const Plane& a, const Plane& b) {
  assert(a.width == b.width && a.height == b.height);
  Plane out(a.width, a.height);
  for (size_t i = 0; i < out.data.size(); ++i) out.data[i] = a.data[i] - b.data[i];
  return out;
}

/// (numerator - subtrahend) / denominator, guarded. Returns the number of guarded pixels.
int64_t divide(const Plane& minuend, const Plane& subtrahend, const Plane& denominator, double epsilon,
               Plane& out) {
  int64_t guarded = 0;
  out = Plane(minuend.width, minuend.height);
  for (size_t i = 0; i < out.data.size(); ++i) {
    const double below = denominator.data[i];
    if (!(below >= epsilon)) ++guarded;
    out.data[i] = (minuend.data[i] - subtrahend.data[i]) / std::max(below, epsilon);
  }
  return guarded;
}

double rootMeanSquare(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return values.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(values.size()));
}

double median(std::vector<double>& values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

int mostLevels(int width, int height) {
  int levels = 1;
  for (int size = std::min(width, height); size > 1; size /= 2) ++levels;
  return levels;
}

std::vector<Plane> gaussianPyramid(const Plane& image, const PyramidSettings& settings) {
  std::vector<Plane> out{image};
  const int levels = std::min(settings.levels, mostLevels(image.width, image.height));
  while (static_cast<int>(out.size()) < levels) {
    const Plane& last = out.back();
    out.push_back(resample(last, reductionTaps(last.width, settings.kernel, settings.border),
                           reductionTaps(last.height, settings.kernel, settings.border)));
  }
  return out;
}

Plane upsampleLevel(const std::vector<Plane>& pyramid, int from, int to, const PyramidSettings& settings) {
  assert(to <= from && from < static_cast<int>(pyramid.size()));
  const Plane& source = pyramid[static_cast<size_t>(from)];
  if (from == to) return source;
  if (settings.upsampler == Upsampler::Bilinear) {
    const Plane& target = pyramid[static_cast<size_t>(to)];
    const bool cosited = !settings.kernel.fused;
    return resample(source, bilinearTaps(source.width, target.width, cosited, from - to, settings.border),
                    bilinearTaps(source.height, target.height, cosited, from - to, settings.border));
  }
  Plane out = source;
  for (int level = from - 1; level >= to; --level) {
    const Plane& target = pyramid[static_cast<size_t>(level)];
    out = upsampleOnce(out, target.width, target.height, settings);
  }
  return out;
}

std::vector<Plane> laplacianPyramid(const std::vector<Plane>& gaussian, const PyramidSettings& settings) {
  std::vector<Plane> out;
  for (size_t i = 0; i + 1 < gaussian.size(); ++i)
    out.push_back(difference(
        gaussian[i], upsampleLevel(gaussian, static_cast<int>(i) + 1, static_cast<int>(i), settings)));
  if (!gaussian.empty()) out.push_back(gaussian.back());
  return out;
}

Plane collapse(const std::vector<Plane>& laplacian, const PyramidSettings& settings) {
  if (laplacian.empty()) return {};
  Plane out = laplacian.back();
  for (size_t i = laplacian.size() - 1; i-- > 0;) {
    const Plane& band = laplacian[i];
    out = upsampleOnce(out, band.width, band.height, settings);
    for (size_t p = 0; p < out.data.size(); ++p) out.data[p] += band.data[p];
  }
  return out;
}

std::vector<Plane> upsampledStack(const std::vector<Plane>& pyramid, const PyramidSettings& settings) {
  std::vector<Plane> out;
  for (size_t i = 0; i < pyramid.size(); ++i)
    out.push_back(upsampleLevel(pyramid, static_cast<int>(i), 0, settings));
  return out;
}

double stackSigmaPx(int level, const Kernel& kernel, double sigmaPx) {
  if (level <= 0) return 0.0;
  // A pyramid's variance at level i is v (1 + 4 + ... + 4^(i-1)) = v (4^i - 1) / 3.
  const double first = sigmaPx > 0.0 ? sigmaPx : 2.0 * std::sqrt(kernel.variancePx2() / 3.0);
  return std::ldexp(first, level - 1);
}

std::vector<Plane> gaussianStack(const Plane& image, const PyramidSettings& settings, double sigmaPx) {
  std::vector<Plane> out{image};
  const int levels = std::min(settings.levels, mostLevels(image.width, image.height));
  for (int level = 1; level < levels; ++level) {
    const double sigma = stackSigmaPx(level, settings.kernel, sigmaPx);
    out.push_back(resample(image, gaussianTaps(image.width, sigma, settings.border),
                           gaussianTaps(image.height, sigma, settings.border)));
  }
  return out;
}

std::vector<Plane> dilatedStack(const Plane& image, const PyramidSettings& settings) {
  std::vector<Plane> out{image};
  const int levels = std::min(settings.levels, mostLevels(image.width, image.height));
  for (int level = 1; level < levels; ++level)
    out.push_back(resample(out.back(),
                           dilatedTaps(image.width, settings.kernel, 1 << (level - 1), settings.border),
                           dilatedTaps(image.height, settings.kernel, 1 << (level - 1), settings.border)));
  return out;
}

std::vector<Plane> repeatedStack(const Plane& image, const PyramidSettings& settings) {
  std::vector<Plane> out{image};
  const int levels = std::min(settings.levels, mostLevels(image.width, image.height));
  for (int level = 1; level < levels; ++level)
    out.push_back(resample(out.back(), dilatedTaps(image.width, settings.kernel, 1, settings.border),
                           dilatedTaps(image.height, settings.kernel, 1, settings.border)));
  return out;
}

std::vector<Plane> differences(const std::vector<Plane>& stack) {
  std::vector<Plane> out;
  for (size_t i = 0; i + 1 < stack.size(); ++i) out.push_back(difference(stack[i], stack[i + 1]));
  if (!stack.empty()) out.push_back(stack.back());
  return out;
}

ContrastLevels contrastPyramid(const std::vector<Plane>& gaussian, const PyramidSettings& settings,
                               double epsilon) {
  ContrastLevels out;
  const int count = static_cast<int>(gaussian.size()) - 2;
  for (int i = 0; i < count; ++i) {
    const Plane finer = upsampleLevel(gaussian, i + 1, i, settings);
    const Plane coarser = upsampleLevel(gaussian, i + 2, i, settings);
    out.levels.emplace_back();
    out.guarded += divide(gaussian[static_cast<size_t>(i)], finer, coarser, epsilon, out.levels.back());
  }
  return out;
}

ContrastLevels contrastStack(const std::vector<Plane>& stack, double epsilon) {
  ContrastLevels out;
  for (size_t i = 0; i + 2 < stack.size(); ++i) {
    out.levels.emplace_back();
    out.guarded += divide(stack[i], stack[i + 1], stack[i + 2], epsilon, out.levels.back());
  }
  return out;
}

Plane finiteNonNegative(const Plane& image, double largest) {
  Plane out = image;
  for (double& value : out.data) value = value > 0.0 ? std::min(value, largest) : 0.0;  // NaN fails the test
  return out;
}

BlockMetric blockMetric(const Plane& image, int level, bool cosited) {
  const int period = 1 << level;
  // Centred: kinks lie between two pixels, in the middle of a block.
  const auto onGrid = [&](int x) {
    const int phase = x % period;
    return cosited ? phase == 0 : phase == period / 2 || phase == (period / 2 + period - 1) % period;
  };
  std::vector<double> on, off;
  const auto add = [&](bool grid, double a, double b, double c) {
    (grid ? on : off).push_back(std::abs(a - 2.0 * b + c));
  };
  for (int y = 0; y < image.height; ++y)
    for (int x = 1; x + 1 < image.width; ++x)
      add(onGrid(x), image.at(x - 1, y), image.at(x, y), image.at(x + 1, y));
  for (int y = 1; y + 1 < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      add(onGrid(y), image.at(x, y - 1), image.at(x, y), image.at(x, y + 1));
  BlockMetric out;
  out.onGrid = rootMeanSquare(on);
  out.offGrid = rootMeanSquare(off);
  out.onGridMedian = median(on);
  out.offGridMedian = median(off);
  return out;
}

}  // namespace limen::perception
