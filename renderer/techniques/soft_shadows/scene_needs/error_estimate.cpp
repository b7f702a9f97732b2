// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/scene_needs/error_estimate.h"

#include <algorithm>
#include <cmath>

namespace limen::techniques {
namespace {

constexpr double kLimits = 2.0;  ///< standard errors

double rootOf(double square) { return std::sqrt(std::max(square, 0.0)); }
bool isReceiver(const ReferencePair& truth, size_t pixel) {
  return truth.receivers.data[4 * pixel + 3] >= 0.0F;
}
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
  double sum = 0.0, count = 0.0;
  for (size_t i = 0; i < first.pixels(); ++i) {
    if (!isReceiver(*this, i)) continue;
    // The variance of half a difference is that of a mean.
    sum += 0.25 * differenceAt(*this, i) * differenceAt(*this, i);
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(sum / count) : 0.0;
}

ErrorEstimate estimateError(const Image& product, const ReferencePair& truth) {
  double sum = 0.0, squares = 0.0, variance = 0.0;
  ErrorEstimate out;
  for (size_t i = 0; i < product.pixels(); ++i) {
    if (!isReceiver(truth, i)) continue;
    const double c = product.data[i];
    const double toMean = c - meanAt(truth, i), between = differenceAt(truth, i);
    // (c - a)(c - b), with the mean and the difference of a and b.
    const double square = std::isfinite(c) ? toMean * toMean - 0.25 * between * between : 1.0;
    sum += square;
    squares += square * square;
    // With sampling errors x and y of variance s and a true error e: (e - x)(e - y) varies by
    // e^2 Var(x + y) + Var(x y) = 2 e^2 s + s^2. toMean^2 is e^2 + s / 2 on average and between^2 is 2 s, so
    // that this is no smaller.
    const double s = 0.5 * between * between;
    if (std::isfinite(c)) variance += 2.0 * toMean * toMean * s + s * s;
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
  Image out(product.width, product.height, 1);
  for (size_t i = 0; i < product.pixels(); ++i)
    if (isReceiver(truth, i))
      out.data[i] = static_cast<float>(std::abs(double(product.data[i]) - meanAt(truth, i)));
  return out;
}

}  // namespace limen::techniques
