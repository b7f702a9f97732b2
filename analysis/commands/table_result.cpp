// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/commands/table_result.h"

#include "experiments/base/error.h"

namespace limen::analysis {

void checkIntervals(double level, size_t samples, bool orNone) {
  if (!(level > 0.0 && level < 1.0))
    throw Error("has to lie between 0 and 1, both excluded", "--confidence", "0.95 is usual");
  if (!(orNone && samples == 0) && (samples < 100 || samples > 1000000))
    throw Error(std::string("has to be 100 to 1000000") + (orNone ? ", or 0 for no bootstrap" : ""),
                "--samples", "2000 are usual");
}

}  // namespace limen::analysis
