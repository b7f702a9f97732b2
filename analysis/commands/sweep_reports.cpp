// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/commands/sweep_reports.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "analysis/output/result_renderers.h"
#include "experiments/base/error.h"
#include "experiments/store/sessions.h"

namespace limen::analysis {

void addSweepReportOptions(CLI::App& command, ReportOptions& options) {
  command.add_option("STORE", options.storePath, "result store with a sweep, a study or both")->required();
  command.add_option(
      "-o,--output", options.folder,
      "folder for report.html, CSV tables, figures and pictures (default: STORE's name with _report, "
      "beside it)");
  command.add_option(
      "--experiment", options.experiment,
      "title or hash (8 digits or more) of one experiment; otherwise all of the store, each in a folder "
      "of its own if there are several");
  command.add_flag("--force", options.force, "report although runs are missing or failed; the page says so");
}

std::string defaultReportFolder(const std::string& store) {
  const std::filesystem::path path = store;
  return (path.parent_path() / (path.stem().string() + "_report")).string();
}

void printPage(const std::string& page, Section facts, bool json) {
  facts.fact(text("event"), "report");
  facts.fact(text("page"), page);
  std::printf("%s\n",
              json ? toJson(facts).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).c_str()
                   : page.c_str());
}

void printReport(const ReportResult& result, bool json) {
  Section facts;
  facts.fact(text("title"), result.title);
  facts.fact(text("experiment"), result.hash);
  facts.fact(integer("runs"), result.runs);
  facts.fact(integer("failed"), result.failed);
  facts.fact(integer("missing"), result.missing);
  facts.fact(integer("broken_expectations"), result.brokenExpectations);
  printPage(result.page, std::move(facts), json);
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
