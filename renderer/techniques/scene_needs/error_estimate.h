// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "experiments/base/image.h"

namespace limen::techniques {

/// Mean squared error of a product over the pixels where it is compared, against two references that sample
/// the light independently of each other. For a product c and references a and b it is the mean of (c - a)(c
/// - b): the references' own errors are as often of equal as of opposite sign, so that they add nothing on
/// average, where the mean of (c - a)^2 would include a's variance. Visible differences (JndErrors) are kept
/// in the same form, as the square of what the metric says.
struct ErrorEstimate {
  double meanSquare = 0.0;     ///< below 0 by chance where a product is exact
  double samplingNoise = 0.0;  ///< standard error of meanSquare by the references' samples
  /// Standard error of meanSquare by these and by the choice of pixels, as if errors of neighbours were
  /// independent.
  double standardError = 0.0;
  int64_t pixels = 0;

  /// The root: an RMSE, or JND.
  double value() const;
  /// Limits of that of a picture with many more pixels, some 95 % together: 2 standard errors either way.
  double low() const;
  double high() const;
  /// By how much the references' samples alone may have changed it.
  double noise() const;
};

/// The truth about a picture, known up to sampling.
struct ReferencePair {
  Image first, second;  ///< the product: visibility, or colour, whose first three channels are compared
  Image mask;           ///< 1 channel: above 0 where products are compared

  /// RMS of the sampling error of the mean of both, which estimateError() removes.
  double noise() const;
};

/// Values that are not finite count as an error of 1. With several channels, the mean over them.
ErrorEstimate estimateError(const Image& product, const ReferencePair& truth);
/// |product - mean of both references|, the mean of the channels; 0 where nothing is compared.
Image errorMap(const Image& product, const ReferencePair& truth);

}  // namespace limen::techniques
