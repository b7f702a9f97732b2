// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/output/result.h"
#include "analysis/psychometric/fit.h"
#include "analysis/psychometric/goodness.h"
#include "analysis/psychometric/intervals.h"

namespace limen::analysis {

/// All that one call of `limen analyse fit` found.
struct FitAnswer {
  std::string file, hash;          ///< of the data; the hash is its SHA-256
  std::string part;                ///< of a study; empty for tables
  std::string level;               ///< name of x
  std::string title;               ///< of x for people, with its unit; "" for its name
  std::vector<std::string> notes;  ///< what whoever reads the numbers has to know of the data
  std::vector<Condition> data;
  std::vector<std::map<std::string, std::string>> levels;  ///< of each condition's factors or columns
  Fit fit;
  std::optional<FitIntervals> intervals;
  bool parametric = true;          ///< how replicates of the intervals were drawn
  std::vector<Goodness> goodness;  ///< of each condition, or none
  /// With shared parameters: the same with nothing shared, and the test against it (maximum likelihood only).
  std::optional<Fit> full;
  std::optional<LikelihoodRatio> ratio;
  size_t samples = 0;
  uint64_t seed = 0;
};

/// Tables "parameters", "conditions", "models", and where asked for "goodness", "blocks", "likelihood_ratio".
Section sectionOf(const FitAnswer& answer);
Result resultOf(const std::vector<FitAnswer>& answers);
/// What whoever reads the numbers has to know of data, intervals and fits.
std::vector<std::string> remarksOn(const FitAnswer& answer);

/// Draws data, fitted functions and intervals of the thresholds; beside FILE.svg, .pdf or .png lie its
/// gnuplot script and data. Throws Error.
void drawFit(const FitAnswer& answer, const std::string& path);

/// "threshold", ..., "slope".
const std::string& quantityName(size_t quantity);

}  // namespace limen::analysis
