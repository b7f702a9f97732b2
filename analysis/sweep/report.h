// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "experiments/store/store.h"

namespace limen::analysis {

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

}  // namespace limen::analysis
