// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/commands/sweep_reports.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "experiments/base/error.h"
#include "experiments/store/sessions.h"

namespace limen::analysis {

void addSweepReportOptions(CLI::App& command, ReportOptions& options) {
  command.add_option("STORE", options.storePath, "result store with a sweep, a study or both")->required();
  command
      .add_option("-o,--output", options.folder, "folder for report.html, CSV tables, figures and pictures")
      ->required();
  command.add_option(
      "--experiment", options.experiment,
      "title or hash (8 digits or more) of one experiment; otherwise all of the store, each in a folder "
      "of its own if there are several");
  command.add_flag("--force", options.force, "report although runs are missing or failed; the page says so");
}

void printLine(const nlohmann::json& out) {
  std::printf("%s\n", out.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
}

void printReport(const ReportResult& result, bool json) {
  if (!json) {
    std::printf("%s\n", result.page.c_str());
    return;
  }
  printLine({{"event", "report"},
             {"page", result.page},
             {"title", result.title},
             {"experiment", result.hash},
             {"runs", result.runs},
             {"failed", result.failed},
             {"missing", result.missing},
             {"broken_expectations", result.brokenExpectations}});
}

bool holdsSessions(const std::string& store) {
  std::unique_ptr<store::SessionReader> reader;
  try {
    reader = std::make_unique<store::SessionReader>(store);
  } catch (const Error&) {
    return false;  // of a schema without studies, or no store: the reader of experiments says which
  }
  return !reader->sessions().empty();
}

bool holdsExperiments(const std::string& store) {
  return !store::Store(store, store::Access::ReadOnly).experiments().empty();
}

}  // namespace limen::analysis
