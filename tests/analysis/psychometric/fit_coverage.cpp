// SPDX-License-Identifier: BSD-3-Clause
// Measures how often intervals of each method hold the true value, over experiments drawn from a known
// observer: fit_coverage [TASK [SETS [SAMPLES [FIRST]]]] prints a row for each method and parameter. The numbers of
// analysis/psychometric/coverage.cpp come from it; it is no test and has no verdict.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/analysis/psychometric/simulated_sets.h"

int main(int argc, char** argv) {
  using namespace limen::analysis;
  const std::string task = argc > 1 ? argv[1] : "2afc";
  const int sets = argc > 2 ? std::atoi(argv[2]) : 1000;
  const int samples = argc > 3 ? std::atoi(argv[3]) : 2000;
  const int first = argc > 4 ? std::atoi(argv[4]) : 0;
  const CoverageExperiment experiment = coverageExperiment(task);
  for (const std::string name : {"bootstrap", "nonparametric", "bca", "profile", "laplace", "posterior"}) {
    const CoverageCount count = countCoverage(experiment, name, first, sets, static_cast<size_t>(samples));
    for (size_t quantity = 0; quantity < kFitQuantities; ++quantity)
      if (count.given[quantity] > 0)
        std::printf("%-8s %-14s quantity %zu  %d of %d held\n", task.c_str(), name.c_str(), quantity,
                    count.held[quantity], count.given[quantity]);
    std::fflush(stdout);
  }
}
