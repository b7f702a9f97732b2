// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace limen::experiments {

struct ReportResult {
  std::string path;     ///< the report, "" if there is none
  std::string message;  ///< one line for the user
};

/// Has the sibling program limen-report write a report of `store` into `folder`. A sweep's results do not
/// depend on it, so a missing or failing program is a remark, not an error.
ReportResult makeReport(const std::string& store, const std::string& folder);

}  // namespace limen::experiments
