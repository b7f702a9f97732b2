// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/psychometric/coverage.h"

namespace limen::analysis {

std::vector<std::string> coverageNotes(IntervalMethod, bool) { return {}; }

}  // namespace limen::analysis
