// SPDX-License-Identifier: BSD-3-Clause
#include "perception/psychometrics/sigmoid.h"

#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace limen::psychometrics {

namespace {

StimulusAxis axisOf(SigmoidFamily family, StimulusAxis axis) {
  return family == SigmoidFamily::Weibull ? StimulusAxis::Logarithmic : axis;
}

}  // namespace

Sigmoid::Sigmoid(SigmoidFamily family, StimulusAxis axis, double location, double scale)
    : family_(family), axis_(axisOf(family, axis)), location_(location), scale_(scale) {
  assert(scale > 0.0);
}

Sigmoid Sigmoid::fromThresholdWidth(SigmoidFamily family, StimulusAxis axis, double threshold, double width,
                                    double level, double tail) {
  assert(width > 0.0 && level > 0.0 && level < 1.0 && tail > 0.0 && tail < 0.5);
  const double scale = width / (standardInverseComplement(family, tail) - standardInverse(family, tail));
  const double u = axisOf(family, axis) == StimulusAxis::Logarithmic ? std::log(threshold) : threshold;
  return {family, axis, u - scale * standardInverse(family, level), scale};
}

Sigmoid Sigmoid::fromThresholdSlope(SigmoidFamily family, StimulusAxis axis, double threshold, double slope,
                                    double level) {
  assert(slope > 0.0 && level > 0.0 && level < 1.0);
  const bool logarithmic = axisOf(family, axis) == StimulusAxis::Logarithmic;
  const double z = standardInverse(family, level);
  // dF/dx = S'(z) / scale du/dx, and du/dx = 1/x on a logarithmic axis.
  const double scale = standardDerivative(family, z) / (logarithmic ? slope * threshold : slope);
  return {family, axis, (logarithmic ? std::log(threshold) : threshold) - scale * z, scale};
}

Sigmoid Sigmoid::weibull(double alpha, double beta) {
  assert(alpha > 0.0);
  return {SigmoidFamily::Weibull, StimulusAxis::Logarithmic, std::log(alpha), 1.0 / beta};
}

Sigmoid Sigmoid::weibullLog10(double alpha, double beta) {
  return {SigmoidFamily::Gumbel, StimulusAxis::Linear, alpha, 1.0 / (std::numbers::ln10 * beta)};
}

Sigmoid Sigmoid::weibullDecibel(double threshold, double slope) {
  return {SigmoidFamily::Gumbel, StimulusAxis::Linear, threshold, 20.0 / (std::numbers::ln10 * slope)};
}

Sigmoid Sigmoid::logistic(double alpha, double beta) {
  return {SigmoidFamily::Logistic, StimulusAxis::Linear, alpha, 1.0 / beta};
}

Sigmoid Sigmoid::normal(double mean, double standardDeviation) {
  return {SigmoidFamily::Normal, StimulusAxis::Linear, mean, standardDeviation};
}

double Sigmoid::derivative(double x) const {
  if (axis_ == StimulusAxis::Linear) return standardDerivative(family_, standard(x)) / scale_;
  return x > 0.0 ? standardDerivative(family_, standard(x)) / (scale_ * x) : 0.0;
}

double Sigmoid::width(double tail) const {
  return scale_ * (standardInverseComplement(family_, tail) - standardInverse(family_, tail));
}

double Sigmoid::alpha() const { return axis_ == StimulusAxis::Logarithmic ? std::exp(location_) : location_; }

double Sigmoid::standard(double x) const {
  if (axis_ == StimulusAxis::Linear) return (x - location_) / scale_;
  return x > 0.0 ? (std::log(x) - location_) / scale_ : -std::numeric_limits<double>::infinity();
}

double Sigmoid::stimulus(double z) const {
  const double u = location_ + scale_ * z;
  return axis_ == StimulusAxis::Logarithmic ? std::exp(u) : u;
}

}  // namespace limen::psychometrics
