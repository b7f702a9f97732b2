// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace limen::experiments {

struct ReportResult {
  std::string path;     ///< the report, "" if there is none
  std::string message;  ///< one line for the user
  bool failed = false;  ///< the program that writes it was there and failed; the runs are in the store
};

/// Has the sibling program limen-report write a report of `store` into `folder`. One that was not built is a
/// remark, since a sweep's results do not depend on it.
ReportResult makeReport(const std::string& store, const std::string& folder);

}  // namespace limen::experiments
