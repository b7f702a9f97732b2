// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace limen::psychometrics {

/// Distribution functions S(z) in their standard form, from which psychometric functions are made:
///
///     logistic           1 / (1 + exp(-z))
///     normal             Phi(z), the cumulative Gaussian
///     gumbel             1 - exp(-exp(z)), the Weibull on a logarithmic axis
///     reversed_gumbel    exp(-exp(-z))
///     hyperbolic_secant  (2/pi) atan(exp(pi z / 2))
///     student_t          1/2 + atan(z)/pi, Student's t with one degree of freedom (Cauchy), as in psignifit
///     4 weibull            the Gumbel; its logarithmic axis is handled by Sigmoid
///
/// (Schuett, Harmeling, Macke and Wichmann 2016, Vision Research 122; Kingdom and Prins 2016, chapter 4.)
enum class SigmoidFamily { Logistic, Normal, Weibull, Gumbel, ReversedGumbel, HyperbolicSecant, StudentT };

/// "logistic", "normal", ... as in files.
const std::vector<std::string>& sigmoidNames();
const std::string& nameOf(SigmoidFamily family);
/// Throws Error with the nearest known name.
SigmoidFamily sigmoidFamily(const std::string& name, const std::string& where = {});

/// All of these keep twelve digits wherever the result is a normal number, in both tails: the smaller of S
/// and 1 - S is never obtained by subtraction, and neither logarithm from a rounded 1 or 0. `z` may be
/// infinite.
double standardValue(SigmoidFamily family, double z);          ///< S(z)
double standardComplement(SigmoidFamily family, double z);     ///< 1 - S(z)
double standardLogValue(SigmoidFamily family, double z);       ///< ln S(z)
double standardLogComplement(SigmoidFamily family, double z);  ///< ln(1 - S(z))
double standardDerivative(SigmoidFamily family, double z);     ///< dS/dz
/// The z with S(z) = p, 0 <= p <= 1; -infinity and infinity at the ends.
double standardInverse(SigmoidFamily family, double p);
/// The z with 1 - S(z) = q: for values so close to 1 that p = 1 - q would lose precision.
double standardInverseComplement(SigmoidFamily family, double q);

}  // namespace limen::psychometrics
