// SPDX-License-Identifier: BSD-3-Clause
#include "study/procedures/student_t.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace limen::study {
namespace {

// Probability of |t| <= sqrt(degrees) tan(theta): the finite sums of Abramowitz and Stegun 26.7.3 and 26.7.4.
double within(double theta, int degrees) {
  const double cosine = std::cos(theta), sine = std::sin(theta);
  const bool odd = degrees % 2 == 1;
  double term = odd ? cosine : 1.0, sum = 0.0;
  for (int k = odd ? 3 : 2; k <= degrees; k += 2) {
    sum += term;
    term *= cosine * cosine * (k - 1.0) / k;
  }
  return odd ? 2.0 / std::numbers::pi * (theta + sine * sum) : sine * sum;
}

}  // namespace

double studentQuantile(double level, int degrees) {
  assert(degrees >= 1 && level > 0.0 && level < 1.0);
  double low = 0.0, high = std::numbers::pi / 2.0;
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (low + high);
    (within(middle, degrees) < level ? low : high) = middle;
  }
  return std::sqrt(static_cast<double>(degrees)) * std::tan(low);
}

}  // namespace limen::study
