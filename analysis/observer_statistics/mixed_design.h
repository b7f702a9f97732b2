// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "analysis/observer_statistics/mixed.h"

namespace limen::analysis {

/// Columns of a design matrix, without the intercept.
struct MixedDesign {
  std::vector<ModelColumn> sources;
  std::vector<std::string> names;            ///< "x", "colour=red", "x:colour=red"
  std::vector<std::vector<double>> columns;  ///< by name, then by row
  size_t slope = 0;                          ///< index of names, if a slope was asked for
};

/// Errors as fitMixedModel().
MixedDesign buildDesign(const MixedRows& rows, const MixedTerms& terms);

}  // namespace limen::analysis
