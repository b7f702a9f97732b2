// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/sweep.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <map>
#include <system_error>

#include "experiments/base/environment.h"
#include "experiments/base/error.h"
#include "experiments/base/failure.h"
#include "experiments/base/interrupt.h"
#include "experiments/base/printable.h"
#include "experiments/base/standard_output.h"
#include "experiments/base/text.h"
#include "experiments/catalogue_text.h"
#include "experiments/console.h"
#include "experiments/features.h"
#include "experiments/plan.h"
#include "experiments/report_step.h"
#include "experiments/runner.h"
#include "experiments/sweep_options.h"

namespace limen::experiments {
namespace {

namespace fs = std::filesystem;

struct PlannedSweep {
  Descriptor descriptor;
  Plan plan;
  std::string store;
};

class Sweeper {
 public:
  Sweeper(const SweepProgram& program, const SweepOptions& options, std::vector<std::string> command)
      : program_(program), options_(options), command_(std::move(command)) {}

  int run() {
    if (options_.merge) return mergeStores();
    if (options_.list) return list();
    if (options_.features) return listFeatures();
    const std::vector<PlannedSweep> sweeps = planAll();
    if (options_.dryRun) return printPlans(sweeps);
    installInterruptHandlers();
    int exitCode = kExitSuccess;
    for (const PlannedSweep& sweep : sweeps) {
      exitCode = std::max(exitCode, measure(sweep));
      if (interruptSignal() != 0) break;
      if (options_.failFast && exitCode != kExitSuccess) break;
    }
    return exitCodeAfter(exitCode);
  }

 private:
  void printJson(const nlohmann::json& line) const {
    std::fputs((line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n").c_str(), stdout);
    std::fflush(stdout);
  }

  /// For people: standard output, unless that is taken by JSON lines.
  void say(const std::string& text) const {
    std::FILE* const out = options_.json ? stderr : stdout;
    std::fputs((text + "\n").c_str(), out);
    std::fflush(out);
  }

  int list() const {
    if (*options_.list == "devices") {
      for (const std::string& line : program_.devices ? program_.devices() : std::vector<std::string>{})
        if (options_.json)
          printJson({{"device", line}});
        else
          say(line);
      return kExitSuccess;
    }
    if (options_.json)
      for (const nlohmann::json& line : describeAsJson(program_.catalogue(), *options_.list)) printJson(line);
    else
      std::fputs(describe(program_.catalogue(), *options_.list).c_str(), stdout);
    return kExitSuccess;
  }

  int listFeatures() const {
    const Coverage coverage = readCoverage(options_.root);
    if (options_.json)
      for (const nlohmann::json& line : toJsonLines(coverage)) printJson(line);
    else
      std::fputs(describe(coverage).c_str(), stdout);
    return kExitSuccess;
  }

  int mergeStores() const {
    // All inputs are opened before the output is created, so that a bad name leaves nothing behind.
    std::vector<std::unique_ptr<store::Store>> inputs;
    for (const std::string& path : options_.mergeIn) {
      std::error_code code;
      if (fs::equivalent(path, options_.mergeOut, code))
        throw Error("cannot be merged into itself", path, "name another store");
      inputs.push_back(std::make_unique<store::Store>(path, store::Access::ReadOnly));
    }
    makeFolderOf(options_.mergeOut);
    store::Store out(options_.mergeOut, store::Access::ReadWrite);
    int64_t added = 0;
    for (const auto& input : inputs) added += out.merge(*input);
    if (options_.json) printJson({{"store", options_.mergeOut}, {"merged", inputs.size()}, {"added", added}});
    say(fmt::format("{}: {} runs added from {} stores", options_.mergeOut, added, inputs.size()));
    return kExitSuccess;
  }

  static void makeFolderOf(const std::string& file) {
    const fs::path folder = fs::path(file).parent_path();
    std::error_code code;
    if (!folder.empty()) fs::create_directories(folder, code);
    if (code)
      throw Error("cannot create the folder: " + code.message(), folder.string(),
                  "check permissions and free space");
  }

  /// All descriptors are checked before any is run; every bad one is reported.
  std::vector<PlannedSweep> planAll() const {
    const Catalogue catalogue = program_.catalogue();
    const std::set<std::string> features = knownFeatures(options_.root);
    std::vector<PlannedSweep> out;
    std::vector<std::string> problems;
    for (const std::string& path : options_.descriptors) {
      try {
        PlannedSweep sweep{readDescriptor(path, catalogue, features), {}, options_.store};
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

  int printPlans(const std::vector<PlannedSweep>& sweeps) const {
    for (const PlannedSweep& sweep : sweeps) {
      const std::vector<bool> mine = shardMask(sweep.plan, options_.shardIndex, options_.shardCount);
      const auto count = static_cast<size_t>(std::count(mine.begin(), mine.end(), true));
      const std::string size = describeSize(sweep.descriptor, sweep.plan);
      for (size_t i = 0; i < sweep.plan.runs.size(); ++i) {
        const PlannedRun& run = sweep.plan.runs[i];
        if (!mine[i]) continue;
        if (options_.json)
          printJson({{"key", run.key},
                     {"technique", run.technique.name},
                     {"scene", run.scene.name},
                     {"label", run.label},
                     {"setting", run.setting},
                     {"parameters", run.parameters}});
        else
          say(fmt::format("{:>6}  {}", i + 1, describe(run)));
      }
      if (options_.json)
        printJson({{"planned", count},
                   {"grid", sweep.plan.runs.size()},
                   {"size", size},
                   {"descriptor", sweep.descriptor.path},
                   {"store", sweep.store}});
      else
        say(fmt::format("{}: {}{}; store {}", sweep.descriptor.path, size,
                        options_.shardCount > 1 ? fmt::format("; {} in this shard", count) : "",
                        sweep.store));
    }
    return kExitSuccess;
  }

  Executor& executorFor(const std::string& store) {
    std::string folder = fs::path(store).parent_path().string();
    if (folder.empty()) folder = ".";
    std::unique_ptr<Executor>& executor = executors_[folder];
    if (!executor) executor = program_.makeExecutor(folder);
    return *executor;
  }

  std::unique_ptr<SweepObserver> makeObserver() const {
    if (!options_.json) return isatty(STDOUT_FILENO) ? makeProgressBar(stdout) : makeLinePrinter(stdout);
    auto json = makeJsonPrinter(stdout);
    return isatty(STDERR_FILENO) ? makePair(std::move(json), makeProgressBar(stderr)) : std::move(json);
  }

  /// The input was valid, but device or store failed.
  static int reportFailure(const Error& error) {
    std::fprintf(stderr, "%s\n", printable(error.what()).c_str());
    return kExitFailedRuns;
  }

  int measure(const PlannedSweep& sweep) {
    Executor* executor = nullptr;
    try {
      executor = &executorFor(sweep.store);
    } catch (const Error& error) {
      // A machine without what every run needs.
      reportFailure(error);
      return kExitBadInput;
    }
    makeFolderOf(sweep.store);
    store::Store results(sweep.store, store::Access::ReadWrite);
    say(fmt::format("{}: {}", sweep.descriptor.path, describeSize(sweep.descriptor, sweep.plan)));
    const int64_t experiment = enterExperiment(sweep.descriptor, sweep.plan, results);
    SweepTally tally;
    try {
      const auto observer = makeObserver();
      const RunnerOptions runnerOptions{options_.shardIndex, options_.shardCount, options_.failFast,
                                        options_.retryDied};
      tally = runSweep(sweep.plan, results, *executor, environmentFacts(command_, options_.root),
                       runnerOptions, *observer);
    } catch (const Error& error) {
      return reportFailure(error);
    }
    const bool whole = options_.shardCount == 1 && tally.left == 0;
    std::vector<store::Expectation> expectations;
    if (whole)
      expectations = evaluateExpectations(sweep.descriptor, sweep.plan, experiment,
                                          executor->environment().device, results);
    ReportResult report;
    if (whole && !options_.noReport) report = writeReport(sweep);
    const int exitCode = summarise(sweep, tally, expectations, executor->account(), report.path);
    return report.failed ? std::max(exitCode, kExitFailedRuns) : exitCode;
  }

  ReportResult writeReport(const PlannedSweep& sweep) const {
    const fs::path store = sweep.store;
    const std::string folder = (store.parent_path() / (store.stem().string() + "_report")).string();
    // Charts of a large sweep take a while.
    if (isatty(STDOUT_FILENO)) say("writing the report");
    ReportResult result = makeReport(sweep.store, folder);
    if (result.failed)
      std::fprintf(stderr, "%s: %s\n", calledName(program_.name).c_str(), printable(result.message).c_str());
    else
      say(result.message);
    return result;
  }

  int summarise(const PlannedSweep& sweep, const SweepTally& tally,
                const std::vector<store::Expectation>& expectations, const nlohmann::json& account,
                const std::string& report) const {
    nlohmann::json broken = nlohmann::json::array();
    for (const store::Expectation& expectation : expectations) {
      if (!expectation.held) broken.push_back({{"text", expectation.text}, {"detail", expectation.detail}});
      say(fmt::format("{}: {}: {}", expectation.held ? "held" : "BROKEN", expectation.text,
                      expectation.detail));
    }
    std::string line = fmt::format("{} planned, {} measured, {} done before, {} failed", tally.planned,
                                   tally.done, tally.skipped, tally.failed);
    if (tally.left > 0) line += fmt::format(", {} left", tally.left);
    say(line + "; store " + sweep.store);
    if (tally.interrupted) say("interrupted; the same command resumes where it stopped");
    if (options_.shardCount > 1)
      say(
          fmt::format("shard {}/{}: expectations and report wait for all shards: merge them, then run the "
                      "sweep with --store OUT and without --shard",
                      options_.shardIndex, options_.shardCount));
    if (options_.json)
      printJson({{"planned", tally.planned},
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
                 {"account", account}});
    return tally.failed > 0 || !broken.empty() ? kExitFailedRuns : kExitSuccess;
  }

  const SweepProgram& program_;
  const SweepOptions& options_;
  std::vector<std::string> command_;
  std::map<std::string, std::unique_ptr<Executor>> executors_;
};

int parseAndSweep(int argc, char** argv, const SweepProgram& program) {
  const ParsedOptions parsed = parseOptions(argc, argv, calledName(program.name));
  if (parsed.exitCode) return *parsed.exitCode;
  if (!parsed.options.device.empty()) setenv("LIMEN_EGL_DEVICE", parsed.options.device.c_str(), 1);
  std::vector<std::string> command(argv, argv + argc);
  command[0] = program.name;
  try {
    return Sweeper(program, parsed.options, std::move(command)).run();
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", printable(error.what()).c_str());
    return exitCodeAfter(kExitBadInput);
  } catch (...) {
    return reportFailure(calledName(program.name));
  }
}

}  // namespace

int sweepMain(int argc, char** argv, const SweepProgram& program) {
  return afterStandardOutput(calledName(program.name), parseAndSweep(argc, argv, program));
}

}  // namespace limen::experiments
