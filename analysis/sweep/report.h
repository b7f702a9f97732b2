// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "analysis/sweep/sweep.h"
#include "experiments/store/store.h"

namespace limen::analysis {

/// Digits of a hash that are enough to name an experiment.
inline constexpr size_t kShortHash = 8;

/// The experiments of a store that `wanted` means: a title, a hash or its first kShortHash digits or more;
/// "": all. Throws Error: the store is empty, nothing is called so (with the nearest title), or several are.
std::vector<store::Experiment> chooseExperiments(const store::Store& store, const std::string& wanted);

/// Throws Error if runs of the plan are missing or failed, naming one.
void requireComplete(const Sweep& sweep, const std::string& storePath);

struct ReportOptions {
  std::string storePath, folder;
  std::string experiment;   ///< title, hash or the beginning of a hash; "": every experiment of the store
  bool force = false;       ///< go on although cells are missing or failed
  bool ownFolders = false;  ///< each experiment in a folder of its own, even if it is the only one
};

/// What was written for one experiment.
struct ReportResult {
  std::string page, title, hash;
  size_t runs = 0, failed = 0, missing = 0, brokenExpectations = 0;
};

/// Writes report.html, CSV tables, charts/ and pictures/ into the folder; with several experiments each goes
/// into a folder of its own below. Throws Error if the store cannot be read, the experiment is unknown, or
/// (without `force`) cells of a plan are missing or failed; nothing is written then.
std::vector<ReportResult> writeReports(const ReportOptions& options);

/// runs.csv as text: one row a run, parameters and measurements, full precision.
std::string runsCsv(const Sweep& sweep);

/// Writes runs.csv (one row a run: parameters and measurements), measurements.csv (long form),
/// frame_times.csv and passes.csv into `folder`, and beside them what their names mean: quantities.csv and
/// parameters.csv. Full precision; an absent value is an empty field. Failed
/// runs are in runs.csv.
void exportTables(const Sweep& sweep, const std::string& folder);

}  // namespace limen::analysis
