// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/base/problems.h"
#include "experiments/descriptor.h"
#include "experiments/executor.h"
#include "experiments/store/store.h"

namespace limen::experiments {

/// An expectation with the planned runs that it applies to.
struct ResolvedExpectation {
  struct Case {
    size_t run = 0;                  ///< index into the plan
    std::optional<size_t> baseline;  ///< run whose value the bound multiplies
  };
  const ExpectationStatement* statement = nullptr;
  std::vector<Case> cases;
};

/// Finds the runs of each statement. A statement that matches no run, or whose `relative_to` matches none or
/// several, becomes a problem. The statements must outlive the result.
std::vector<ResolvedExpectation> resolve(const std::vector<ExpectationStatement>& statements,
                                         const std::vector<PlannedRun>& runs, Problems& problems);

/// Evaluates against what was measured, by run key. A run that failed, is missing or yielded no number fails
/// every expectation about it. `below` and `above` are strict, `equals` is exact.
std::vector<store::Expectation> evaluate(const std::vector<ResolvedExpectation>& expectations,
                                         const std::vector<PlannedRun>& runs,
                                         const std::map<std::string, const store::Run*>& measured);

}  // namespace limen::experiments
