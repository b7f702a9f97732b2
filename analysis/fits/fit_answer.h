// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/psychometric/fit.h"
#include "analysis/psychometric/goodness.h"
#include "analysis/psychometric/intervals.h"

namespace limen::analysis {

/// All that one call of `limen analyse fit` found.
struct FitAnswer {
  std::string file, hash;          ///< of the data; the hash is its SHA-256
  std::string part;                ///< of a study; empty for tables
  std::string level;               ///< name of x
  std::vector<std::string> notes;  ///< what whoever reads the numbers has to know of the data
  std::vector<Condition> data;
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

std::string toText(const FitAnswer& answer);
nlohmann::json toJson(const FitAnswer& answer);
/// One row for each condition and quantity: condition, parameter, estimate, low, high, ...; of several
/// answers with their part before it.
std::string toCsv(const FitAnswer& answer);
std::string toCsv(const std::vector<FitAnswer>& parts);

/// Draws data, fitted functions and intervals of the thresholds; beside FILE.svg, .pdf or .png lie its
/// gnuplot script and data. Throws Error.
void drawFit(const FitAnswer& answer, const std::string& path);

/// "threshold", ..., "slope".
const std::string& quantityName(size_t quantity);

}  // namespace limen::analysis
