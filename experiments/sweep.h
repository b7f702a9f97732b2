// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "experiments/base/catalogue.h"
#include "experiments/executor.h"

namespace limen::experiments {

/// What a sweep program consists of: the names it knows and the executor that runs them.
struct SweepProgram {
  std::string name;
  std::function<Catalogue()> catalogue;
  /// Makes the executor whose artefacts go below `resultsFolder` and whose reference products are kept in
  /// `referencesFolder`. Called only when there is a sweep to run; throws Error.
  std::function<std::unique_ptr<Executor>(const std::string& resultsFolder,
                                          const std::string& referencesFolder)>
      makeExecutor;
  /// The devices that --device can choose, by their indices; null: there are none.
  std::function<std::vector<SweepDevice>()> devices = {};
  /// The same as far as it is known without opening any: without names.
  std::function<std::vector<SweepDevice>()> unopenedDevices = {};
  /// Opens the one that --device names, for the executor that is made next. Throws Error.
  std::function<SweepDevice()> openDevice = {};
};

/// The command line of `limen sweep`. Returns the exit code: 0; 1 for failed runs, broken expectations or a
/// failing device; 2 for bad input (nothing was run or written); 128 + signal when interrupted.
int sweepMain(int argc, char** argv, const SweepProgram& program);

}  // namespace limen::experiments
