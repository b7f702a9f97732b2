// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/base/catalogue.h"
#include "experiments/base/error.h"
#include "experiments/descriptor.h"
#include "experiments/plan.h"
#include "experiments/runner.h"
#include "experiments/sweep_options.h"

namespace limen::experiments {

struct PlannedSweep {
  Descriptor descriptor;
  Plan plan;
  std::string store;
};

/// All descriptors are checked before any is run; the Error tells of every bad one.
std::vector<PlannedSweep> planSweeps(const SweepOptions& options, const Catalogue& catalogue);

/// Standard output takes JSON lines with --json, and what is for people otherwise, which then goes to
/// standard error.
class SweepOutput {
 public:
  explicit SweepOutput(const SweepOptions& options) : json_(options.json) {}
  bool json() const { return json_; }
  void printJson(const nlohmann::json& line) const;
  void say(const std::string& text) const;
  /// Bar, lines or JSON for each run, as the streams are.
  std::unique_ptr<SweepObserver> makeObserver() const;

 private:
  bool json_;
};

/// The input was valid, but device or store failed. Returns the exit code.
int reportSweepFailure(const Error& error);

/// Makes the folder of a file that is to be written. Throws Error.
void makeFolderOf(const std::string& file);

/// What a sweep ends with: expectations and report if it is whole, and the summary. Returns the exit code.
/// `device` is the one whose results the expectations are about, "" for whichever has each run.
struct SweepEnd {
  bool whole = true, report = true;
  std::string program, device;
  std::string note;  ///< said after the summary, "" for nothing
  nlohmann::json account = nlohmann::json::object();
};
int endSweep(const PlannedSweep& sweep, const SweepTally& tally, int64_t experiment, store::Store& results,
             const SweepEnd& end, const SweepOutput& output);

}  // namespace limen::experiments
