// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/sweep/report.h"

#include <fmt/format.h>

#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen::analysis {

std::vector<store::Experiment> chooseExperiments(const store::Store& store, const std::string& wanted) {
  const std::vector<store::Experiment> all = store.experiments();
  if (all.empty()) throw Error("the store holds no experiment", store.path(), "run limen sweep first");
  if (wanted.empty()) return all;
  std::vector<store::Experiment> found;
  std::vector<std::string> names;
  for (const store::Experiment& experiment : all) {
    names.push_back(experiment.title);
    const bool byHash = wanted.size() >= kShortHash && experiment.hash.starts_with(wanted);
    if (experiment.title == wanted || byHash) found.push_back(experiment);
  }
  if (found.empty()) throw Error("no experiment '" + wanted + "'", "--experiment", suggest(wanted, names));
  if (found.size() > 1) {
    std::vector<std::string> hashes;
    for (const store::Experiment& experiment : found) hashes.push_back(experiment.hash.substr(0, 12));
    throw Error(fmt::format("{} experiments have the title '{}'", found.size(), wanted), "--experiment",
                "name one by its hash: " + join(hashes));
  }
  return found;
}

}  // namespace limen::analysis
