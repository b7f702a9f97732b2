// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/scene_needs/error_estimate.h"

#include <algorithm>
#include <cmath>

namespace limen::techniques {
namespace {

constexpr double kLimits = 2.0;  ///< standard errors

double rootOf(double square) { return std::sqrt(std::max(square, 0.0)); }
/// Of each pixel; alpha is no part of a colour.
size_t comparedChannels(const Image& image) { return image.channels < 3 ? size_t(image.channels) : 3U; }
bool isCompared(const ReferencePair& truth, size_t pixel) { return truth.mask.data[pixel] > 0.0F; }
double differenceAt(const ReferencePair& truth, size_t i) {
  return double(truth.first.data[i]) - double(truth.second.data[i]);
}
double meanAt(const ReferencePair& truth, size_t i) {
  return 0.5 * (double(truth.first.data[i]) + double(truth.second.data[i]));
}

}  // namespace

double ErrorEstimate::value() const { return rootOf(meanSquare); }
double ErrorEstimate::low() const { return rootOf(meanSquare - kLimits * standardError); }
double ErrorEstimate::high() const { return rootOf(meanSquare + kLimits * standardError); }
double ErrorEstimate::noise() const { return rootOf(meanSquare + kLimits * samplingNoise) - value(); }

double ReferencePair::noise() const {
  const size_t channels = comparedChannels(first), stride = size_t(first.channels);
  double sum = 0.0, count = 0.0;
  for (size_t pixel = 0; pixel < first.pixels(); ++pixel) {
    if (!isCompared(*this, pixel)) continue;
    for (size_t c = 0; c < channels; ++c) {
      // The variance of half a difference is that of a mean.
      const double between = differenceAt(*this, stride * pixel + c);
      sum += 0.25 * between * between;
      count += 1.0;
    }
  }
  return count > 0.0 ? std::sqrt(sum / count) : 0.0;
}

ErrorEstimate estimateError(const Image& product, const ReferencePair& truth) {
  const size_t channels = comparedChannels(product), stride = size_t(product.channels);
  double sum = 0.0, squares = 0.0, variance = 0.0;
  ErrorEstimate out;
  for (size_t pixel = 0; pixel < product.pixels(); ++pixel) {
    if (!isCompared(truth, pixel)) continue;
    double square = 0.0, noise = 0.0;  // sums over the channels
    for (size_t c = 0; c < channels; ++c) {
      const size_t i = stride * pixel + c;
      const double value = product.data[i];
      const double toMean = value - meanAt(truth, i), between = differenceAt(truth, i);
      // (c - a)(c - b), with the mean and the difference of a and b.
      square += std::isfinite(value) ? toMean * toMean - 0.25 * between * between : 1.0;
      // With sampling errors x and y of variance s and a true error e: (e - x)(e - y) varies by
      // e^2 Var(x + y) + Var(x y) = 2 e^2 s + s^2. toMean^2 is e^2 + s / 2 on average and between^2 is 2 s,
      // so that this is no smaller. Channels share their samples: standard deviations add.
      const double s = 0.5 * between * between;
      if (std::isfinite(value)) noise += std::sqrt(2.0 * toMean * toMean * s + s * s);
    }
    const double mean = square / double(channels);
    sum += mean;
    squares += mean * mean;
    variance += noise * noise / double(channels * channels);
    ++out.pixels;
  }
  if (out.pixels == 0) return out;
  const auto n = double(out.pixels);
  out.meanSquare = sum / n;
  out.samplingNoise = std::sqrt(variance) / n;
  out.standardError = std::sqrt(std::max(squares / n - out.meanSquare * out.meanSquare, 0.0) / n);
  return out;
}

Image errorMap(const Image& product, const ReferencePair& truth) {
  const size_t channels = comparedChannels(product), stride = size_t(product.channels);
  Image out(product.width, product.height, 1);
  for (size_t pixel = 0; pixel < product.pixels(); ++pixel) {
    if (!isCompared(truth, pixel)) continue;
    double sum = 0.0;
    for (size_t i = stride * pixel; i < stride * pixel + channels; ++i)
      sum += std::abs(double(product.data[i]) - meanAt(truth, i));
    out.data[pixel] = static_cast<float>(sum / double(channels));
  }
  return out;
}

}  // namespace limen::techniques
