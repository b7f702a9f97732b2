// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "analysis/output/result.h"
#include "analysis/sweep/report.h"

namespace CLI {
class App;
}

namespace limen::analysis {

/// STORE, -o, --experiment, --force: what limen-report and `limen analyse report` have in common.
void addSweepReportOptions(CLI::App& command, ReportOptions& options);

/// Where the report of a store goes unless -o says otherwise: results/quick_report for results/quick.sqlite,
/// as a sweep writes it.
std::string defaultReportFolder(const std::string& store);

/// One line for a page that was written: its path, or its facts as JSON.
void printPage(const std::string& page, Section facts, bool json);
void printReport(const ReportResult& result, bool json);

/// Whether a store holds a session of any study; false for one whose schema has no sessions.
bool holdsSessions(const std::string& store);
/// Throws Error for a store that cannot be read.
bool holdsExperiments(const std::string& store);

}  // namespace limen::analysis
