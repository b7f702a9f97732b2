// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "perception/psychometrics/standard_sigmoid.h"

namespace limen::psychometrics {

/// On a logarithmic axis a sigmoid is one of u = ln x; at x <= 0 its value is 0.
enum class StimulusAxis { Linear, Logarithmic };

/// A sigmoid F of a stimulus x: F(x) = S((u - location) / scale) with S the standard form of its family and
/// u = x or ln x. It rises from 0 to 1; guesses and lapses are PsychometricFunction's.
///
/// The same curve in other parametrisations:
///   - threshold and width (psignifit 4; Schuett et al. 2016): threshold is the x at which F has `level`
///     (one half unless stated), width the distance on the axis from F = 0.05 to 0.95. On a logarithmic axis
///     the threshold is in units of x and the width in units of ln x;
///   - Weibull 1 - exp(-(x/alpha)^beta), logistic 1 / (1 + exp(-beta (x - alpha))), Gumbel
///     1 - exp(-10^(beta (x - alpha))) and so on (Kingdom and Prins 2016, 4.3.2), normal by mean and SD;
///   - threshold and slope dF/dx there.
class Sigmoid {
 public:
  /// `scale` > 0. Weibull is always logarithmic, whatever `axis` says: it is the Gumbel of ln x.
  Sigmoid(SigmoidFamily family, StimulusAxis axis, double location, double scale);

  /// `width` > 0, 0 < `level` < 1; on a logarithmic axis `threshold` > 0. `tail` is the F at which the width
  /// begins; it ends at 1 - tail.
  static Sigmoid fromThresholdWidth(SigmoidFamily family, StimulusAxis axis, double threshold, double width,
                                    double level = 0.5, double tail = 0.05);
  /// `slope` = dF/dx at the threshold, in units of 1/x on either axis; > 0.
  static Sigmoid fromThresholdSlope(SigmoidFamily family, StimulusAxis axis, double threshold, double slope,
                                    double level = 0.5);
  static Sigmoid weibull(double alpha, double beta);  ///< 1 - exp(-(x/alpha)^beta)
  static Sigmoid weibullLog10(double alpha,
                              double beta);  ///< x in log10 units: 1 - exp(-10^(beta (x - alpha)))
  /// x in decibels: 1 - exp(-10^(slope (x - threshold) / 20)) (Watson 2017, Journal of Vision 17(3):10, eq.
  /// 5).
  static Sigmoid weibullDecibel(double threshold, double slope);
  static Sigmoid logistic(double alpha, double beta);  ///< 1 / (1 + exp(-beta (x - alpha)))
  static Sigmoid normal(double mean, double standardDeviation);

  double value(double x) const { return standardValue(family_, standard(x)); }
  double complement(double x) const { return standardComplement(family_, standard(x)); }  ///< 1 - F
  double logValue(double x) const { return standardLogValue(family_, standard(x)); }
  double logComplement(double x) const { return standardLogComplement(family_, standard(x)); }
  /// dF/dx; 0 for x <= 0 on a logarithmic axis.
  double derivative(double x) const;
  /// The x with F(x) = p.
  double inverse(double p) const { return stimulus(standardInverse(family_, p)); }
  /// The x with 1 - F(x) = q.
  double inverseComplement(double q) const { return stimulus(standardInverseComplement(family_, q)); }

  SigmoidFamily family() const { return family_; }
  StimulusAxis axis() const { return axis_; }
  double location() const { return location_; }  ///< on the axis: of ln x if that is logarithmic
  double scale() const { return scale_; }        ///< on the axis; the SD of a normal
  double threshold(double level = 0.5) const { return inverse(level); }
  double width(double tail = 0.05) const;
  double slopeAtThreshold(double level = 0.5) const { return derivative(inverse(level)); }
  /// Classic forms of logarithmic axes: exp(location), Weibull's alpha, and 1/scale, its beta. On linear axes
  /// alpha is the location and beta 1/scale as for the logistic.
  double alpha() const;
  double beta() const { return 1.0 / scale_; }

 private:
  double standard(double x) const;  ///< z of x
  double stimulus(double z) const;  ///< x of z

  SigmoidFamily family_;
  StimulusAxis axis_;
  double location_, scale_;
};

}  // namespace limen::psychometrics
