// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "experiments/base/catalogue.h"
#include "experiments/executor.h"

namespace limen::experiments {

/// Scenes `grid` and `mesh`, techniques `soft/bitmask`, `soft/pcss`, `colour/lambert`, the reference
/// `soft/sampled`, and metrics `rmse`, `largest_error`, `flip` and `crack_count`.
Catalogue fakeCatalogue();

/// Sleeps `sleep_ms` a run. rmse of soft/bitmask is 1 / samples, that of others their radius (0.5 without
/// one); crack_count is 0; gpu_ms is samples / 10. A run with `fail: true` fails.
class FakeExecutor : public Executor {
 public:
  explicit FakeExecutor(std::string device = "fake device");
  const store::Environment& environment() const override { return environment_; }
  void execute(std::span<const PlannedRun> batch,
               const std::function<void(size_t, RunOutcome)>& finished) override;

  /// Keys in the order of execution, and the size of each batch.
  std::vector<std::string> executed;
  std::vector<size_t> batchSizes;
  /// Called before each run, if set.
  std::function<void(const PlannedRun&)> before;

 private:
  store::Environment environment_;
};

/// rmse that FakeExecutor gives a run.
double fakeRmse(const PlannedRun& run);

/// A descriptor of 2 scenes x (3 + 2) techniques that every check accepts.
std::string validDescriptor();

}  // namespace limen::experiments
