// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/sweep.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <map>
#include <system_error>
#include <unordered_set>

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
#include "experiments/runner.h"
#include "experiments/shared_sweep.h"
#include "experiments/sweep_options.h"
#include "experiments/sweep_steps.h"
#include "experiments/task_progress.h"

namespace limen::experiments {
namespace {

namespace fs = std::filesystem;

class Sweeper {
 public:
  Sweeper(const SweepProgram& program, const SweepOptions& options, std::vector<std::string> command)
      : program_(program), options_(options), command_(std::move(command)), output_(options) {}

  int run() {
    switch (options_.command) {
      case SweepOptions::Command::Merge:
        return mergeStores();
      case SweepOptions::Command::Submit:
        return submitSweeps(program_, options_);
      case SweepOptions::Command::Status:
        return showStatus(options_);
      case SweepOptions::Command::Job:
        return options_.jobVerb == "task" ? keepTask(options_) : mergeTasks(program_, options_);
      case SweepOptions::Command::Sweep:
        break;
    }
    if (options_.list) return list();
    if (options_.features) return listFeatures();
    if (!options_.gpus.empty() && !options_.dryRun) return sweepOnDevices(program_, options_);
    const std::vector<PlannedSweep> sweeps = planSweeps(options_, program_.catalogue());
    if (options_.share) requirePlanned(sweeps);
    if (options_.share && !options_.share->queueFile.empty())
      queue_.emplace(options_.share->queueFile, options_.share->task);
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
  int list() const {
    if (*options_.list == "devices") {
      const std::vector<SweepDevice> devices =
          program_.devices ? program_.devices() : std::vector<SweepDevice>{};
      for (size_t i = 0; i < devices.size(); ++i) {
        const std::string line =
            fmt::format("{}  {}{}{}", i, devices[i].name.empty() ? "(no OpenGL 4.5)" : devices[i].name,
                        devices[i].software ? ", software renderer" : "",
                        devices[i].assigned.value_or(true) ? "" : ", not given to this job by Slurm");
        if (options_.json)
          output_.printJson({{"device", line}});
        else
          output_.say(line);
      }
      return kExitSuccess;
    }
    if (options_.json)
      for (const nlohmann::json& line : describeAsJson(program_.catalogue(), *options_.list))
        output_.printJson(line);
    else
      std::fputs(describe(program_.catalogue(), *options_.list).c_str(), stdout);
    return kExitSuccess;
  }

  int listFeatures() const {
    const Coverage coverage = readCoverage(options_.root);
    if (options_.json)
      for (const nlohmann::json& line : toJsonLines(coverage)) output_.printJson(line);
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
    if (options_.json)
      output_.printJson({{"store", options_.mergeOut}, {"merged", inputs.size()}, {"added", added}});
    output_.say(fmt::format("{}: {} runs added from {} stores", options_.mergeOut, added, inputs.size()));
    return kExitSuccess;
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
          output_.printJson({{"key", run.key},
                             {"technique", run.technique.name},
                             {"scene", run.scene.name},
                             {"label", run.label},
                             {"setting", run.setting},
                             {"parameters", run.parameters}});
        else
          output_.say(fmt::format("{:>6}  {}", i + 1, describe(run)));
      }
      if (options_.json)
        output_.printJson({{"planned", count},
                           {"grid", sweep.plan.runs.size()},
                           {"size", size},
                           {"descriptor", sweep.descriptor.path},
                           {"store", sweep.store}});
      else
        output_.say(fmt::format("{}: {}{}; store {}", sweep.descriptor.path, size,
                                options_.shardCount > 1 ? fmt::format("; {} in this shard", count) : "",
                                sweep.store));
    }
    return kExitSuccess;
  }

  Executor& executorFor(const std::string& store) {
    std::string folder = fs::path(store).parent_path().string();
    if (folder.empty()) folder = ".";
    std::unique_ptr<Executor>& executor = executors_[folder];
    if (!executor)
      executor = program_.makeExecutor(
          folder, options_.references.empty() ? folder + "/references" : options_.references);
    return *executor;
  }

  int measure(const PlannedSweep& sweep) {
    Executor* executor = nullptr;
    try {
      executor = &executorFor(sweep.store);
    } catch (const Error& error) {
      // A machine without what every run needs.
      reportSweepFailure(error);
      return kExitBadInput;
    }
    makeFolderOf(sweep.store);
    store::Store results(sweep.store, store::Access::ReadWrite);
    output_.say(fmt::format("{}: {}", sweep.descriptor.path, describeSize(sweep.descriptor, sweep.plan)));
    const auto* const only = options_.share ? &options_.share->keys : nullptr;
    const int64_t experiment = enterExperiment(sweep.descriptor, sweep.plan, results, only);
    SweepTally tally;
    try {
      auto observer = output_.makeObserver();
      RunnerOptions runnerOptions{options_.shardIndex, options_.shardCount, options_.failFast,
                                  options_.retryDied};
      if (options_.share) {
        observer = makePair(std::move(observer), makeProgressWriter(options_.share->progressFile));
        runnerOptions.only = only;
        if (queue_) runnerOptions.queue = &*queue_;
        runnerOptions.begin = static_cast<double>(options_.share->task - 1) / options_.share->tasks;
      }
      tally = runSweep(sweep.plan, results, *executor, environmentFacts(command_, options_.root),
                       runnerOptions, *observer);
    } catch (const Error& error) {
      return reportSweepFailure(error);
    }
    SweepEnd end;
    end.whole = options_.shardCount == 1 && !options_.share && tally.left == 0;
    end.report = !options_.noReport;
    end.program = program_.name;
    end.device = executor->environment().device;
    end.account = executor->account();
    if (options_.shardCount > 1)
      end.note = fmt::format(
          "shard {}/{}: expectations and report wait for all shards: merge them, then run the sweep with "
          "--store OUT and without --shard",
          options_.shardIndex, options_.shardCount);
    return endSweep(sweep, tally, experiment, results, end, output_);
  }

  /// All of a task's runs must be planned: what was shared out is what is measured.
  void requirePlanned(const std::vector<PlannedSweep>& sweeps) const {
    size_t found = 0;
    std::unordered_set<std::string> seen;
    for (const PlannedSweep& sweep : sweeps)
      for (const PlannedRun& run : sweep.plan.runs)
        found += options_.share->keys.count(run.key) > 0 && seen.insert(run.key).second ? 1 : 0;
    if (found == options_.share->keys.size()) return;
    throw Error(fmt::format("{} of {} runs are not planned any more: the descriptor, a file that it names or "
                            "the program was changed after it was submitted",
                            options_.share->keys.size() - found, options_.share->keys.size()),
                join(options_.descriptors), "cancel the jobs (scancel), then limen submit again");
  }

  const SweepProgram& program_;
  const SweepOptions& options_;
  std::vector<std::string> command_;
  SweepOutput output_;
  std::map<std::string, std::unique_ptr<Executor>> executors_;
  std::optional<SharedQueue> queue_;
};

int parseAndSweep(int argc, char** argv, const SweepProgram& program) {
  const ParsedOptions parsed = parseOptions(argc, argv, calledName(program.name));
  if (parsed.exitCode) return *parsed.exitCode;
  std::vector<std::string> command(argv, argv + argc);
  command[0] = program.name;
  try {
    SweepOptions options = parsed.options;
    const bool isJob = options.command == SweepOptions::Command::Job;
    if (isJob && options.jobVerb == "stand_by") {
      const std::optional<SweepOptions> told = standBy(program, options);
      if (!told) return kExitSuccess;
      options = *told;
      command = {program.name,
                 "job",
                 "measure",
                 options.jobFolder,
                 fmt::format("--task={}", options.jobTask),
                 "--device=" + options.device};
    }
    if (isJob && options.jobVerb == "measure") options = optionsOfTask(options);
    if (!options.device.empty()) setenv("LIMEN_EGL_DEVICE", options.device.c_str(), 1);
    return Sweeper(program, options, std::move(command)).run();
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
