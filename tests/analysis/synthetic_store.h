// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "experiments/store/store.h"

namespace limen::analysis {

/// A fresh folder that goes with the object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::string path(const std::string& name = {}) const { return (folder_ / name).string(); }

 private:
  std::filesystem::path folder_;
};

/// A run with one 'frame' time for each of `ms`, in three rounds of equal length, and the median as gpu_ms.
store::Run makeRun(const std::string& technique, const std::string& scene, int samples,
                   const std::vector<double>& ms, double rmse);

/// Writes runs as one experiment whose plan has them all and the entries of `missing`. Without `descriptions`
/// it is as a sweep of schema 2 left it. Returns the experiment's id.
int64_t writeExperiment(store::Store& store, store::Experiment experiment, std::vector<store::Run> runs,
                        const std::vector<store::PlanEntry>& missing = {},
                        const store::Environment& environment = {"Test GPU",
                                                                 false,
                                                                 {{"command", "limen-sweep x"}}},
                        const store::Descriptions& descriptions = {});

/// Six techniques, three scenes, costs and errors over decades, with counters, passes and pictures, as a real
/// sweep leaves them. Returns the number of runs.
size_t writeLargeExperiment(const std::string& storePath, bool software);

}  // namespace limen::analysis
