// SPDX-License-Identifier: BSD-3-Clause
// Measures how often intervals hold the true value, over experiments drawn from a known observer:
//
//     fit_coverage [TASK [SETS [SAMPLES [METHODS [FIRST]]]]]
//
// (2afc, 1000, 2000, all, 0) prints a line for each method and parameter: task, method, parameter, how many
// intervals held, how many there were. METHODS is a list with commas. Experiments are numbered, and each
// depends on its number alone, so that many processes share the work, each with its own FIRST; the lines are
// summed:
//
//     seq 0 10 990 | xargs -P 16 -I{} fit_coverage 2afc 10 2000 all {} |
//       awk '{h[$1" "$2" "$3] += $4; n[$1" "$2" "$3] += $5} END {for (k in h) print k, h[k], n[k]}' | sort
//
// The numbers of analysis/psychometric/coverage.cpp come from it; it is no test and has no verdict.
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "tests/analysis/psychometric/simulated_sets.h"

int main(int argc, char** argv) {
  using namespace limen::analysis;
  const std::string task = argc > 1 ? argv[1] : "2afc";
  const int sets = argc > 2 ? std::atoi(argv[2]) : 1000;
  const int samples = argc > 3 ? std::atoi(argv[3]) : 2000;
  const std::string list = argc > 4 ? argv[4] : "all";
  const int first = argc > 5 ? std::atoi(argv[5]) : 0;
  std::vector<std::string> methods;
  std::istringstream names(list == "all" ? "bootstrap,nonparametric,bca,profile,laplace,posterior" : list);
  for (std::string name; std::getline(names, name, ',');) methods.push_back(name);
  const std::vector<CoverageCount> counts =
      countCoverage(coverageExperiment(task), methods, first, sets, static_cast<size_t>(samples));
  for (size_t m = 0; m < methods.size(); ++m)
    for (size_t i = 0; i < kFitParameters; ++i)
      if (counts[m].given[i] > 0)
        std::printf("%s %s %s %d %d\n", task.c_str(), methods[m].c_str(), fitParameterNames()[i].c_str(),
                    counts[m].held[i], counts[m].given[i]);
}
