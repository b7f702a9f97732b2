// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/sweep_steps.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <set>
#include <system_error>

#include "experiments/base/failure.h"
#include "experiments/base/printable.h"
#include "experiments/base/text.h"
#include "experiments/console.h"
#include "experiments/features.h"
#include "experiments/report_step.h"

namespace limen::experiments {
namespace {

namespace fs = std::filesystem;

ReportResult writeReport(const PlannedSweep& sweep, const SweepEnd& end, const SweepOutput& output) {
  const fs::path store = sweep.store;
  const std::string folder = (store.parent_path() / (store.stem().string() + "_report")).string();
  // Charts of a large sweep take a while.
  if (isatty(STDOUT_FILENO)) output.say("writing the report");
  ReportResult result = makeReport(sweep.store, folder);
  if (result.failed)
    std::fprintf(stderr, "%s: %s\n", calledName(end.program).c_str(), printable(result.message).c_str());
  else
    output.say(result.message);
  return result;
}

int summarise(const PlannedSweep& sweep, const SweepTally& tally,
              const std::vector<store::Expectation>& expectations, const SweepEnd& end,
              const std::string& report, const SweepOutput& output) {
  nlohmann::json broken = nlohmann::json::array();
  for (const store::Expectation& expectation : expectations) {
    if (!expectation.held) broken.push_back({{"text", expectation.text}, {"detail", expectation.detail}});
    output.say(fmt::format("{}: {}: {}", expectation.held ? "held" : "BROKEN", expectation.text,
                           expectation.detail));
  }
  std::string line = fmt::format("{} planned, {} measured, {} done before, {} failed", tally.planned,
                                 tally.done, tally.skipped, tally.failed);
  if (tally.left > 0) line += fmt::format(", {} left", tally.left);
  output.say(line + "; store " + sweep.store);
  if (tally.interrupted) output.say("interrupted; the same command resumes where it stopped");
  if (!end.note.empty()) output.say(end.note);
  if (output.json())
    output.printJson({{"planned", tally.planned},
                      {"done", tally.done},
                      {"skipped", tally.skipped},
                      {"failed", tally.failed},
                      {"left", tally.left},
                      {"interrupted", tally.interrupted},
                      {"expectations", expectations.size()},
                      {"broken", broken},
                      {"descriptor", sweep.descriptor.path},
                      {"store", sweep.store},
                      {"report", report.empty() ? nlohmann::json() : nlohmann::json(report)},
                      {"account", end.account}});
  return tally.failed > 0 || !broken.empty() ? kExitFailedRuns : kExitSuccess;
}

}  // namespace

std::vector<PlannedSweep> planSweeps(const SweepOptions& options, const Catalogue& catalogue) {
  const std::set<std::string> features = knownFeatures(options.root);
  std::vector<PlannedSweep> out;
  std::vector<std::string> problems;
  for (const std::string& path : options.descriptors) {
    try {
      PlannedSweep sweep{readDescriptor(path, catalogue, features), {}, options.store};
      sweep.plan = makePlan(sweep.descriptor, catalogue);
      if (sweep.store.empty()) sweep.store = "results/" + fs::path(path).stem().string() + ".sqlite";
      out.push_back(std::move(sweep));
    } catch (const Error& error) {
      problems.emplace_back(error.what());
    }
  }
  if (!problems.empty()) throw Error(join(problems, "\n"));
  return out;
}

void SweepOutput::printJson(const nlohmann::json& line) const {
  std::fputs((line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n").c_str(), stdout);
  std::fflush(stdout);
}

void SweepOutput::say(const std::string& text) const {
  std::FILE* const out = json_ ? stderr : stdout;
  std::fputs((text + "\n").c_str(), out);
  std::fflush(out);
}

std::unique_ptr<SweepObserver> SweepOutput::makeObserver() const {
  if (!json_) return isatty(STDOUT_FILENO) ? makeProgressBar(stdout) : makeLinePrinter(stdout);
  auto json = makeJsonPrinter(stdout);
  return isatty(STDERR_FILENO) ? makePair(std::move(json), makeProgressBar(stderr)) : std::move(json);
}

int reportSweepFailure(const Error& error) {
  std::fprintf(stderr, "%s\n", printable(error.what()).c_str());
  return kExitFailedRuns;
}

void makeFolderOf(const std::string& file) {
  const fs::path folder = fs::path(file).parent_path();
  std::error_code code;
  if (!folder.empty()) fs::create_directories(folder, code);
  if (code)
    throw Error("cannot create the folder: " + code.message(), folder.string(),
                "check permissions and free space");
}

int endSweep(const PlannedSweep& sweep, const SweepTally& tally, int64_t experiment, store::Store& results,
             const SweepEnd& end, const SweepOutput& output) {
  std::vector<store::Expectation> expectations;
  if (end.whole)
    expectations = evaluateExpectations(sweep.descriptor, sweep.plan, experiment, end.device, results);
  ReportResult report;
  if (end.whole && end.report) report = writeReport(sweep, end, output);
  const int exitCode = summarise(sweep, tally, expectations, end, report.path, output);
  return report.failed ? std::max(exitCode, kExitFailedRuns) : exitCode;
}

}  // namespace limen::experiments
