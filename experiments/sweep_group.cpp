// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/sweep_group.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "experiments/base/error.h"
#include "experiments/base/printable.h"
#include "experiments/base/text.h"
#include "experiments/shares.h"

namespace limen::experiments {
namespace {

namespace fs = std::filesystem;

std::string currentFolder() {
  std::error_code code;
  const fs::path here = fs::current_path(code);
  if (code) throw Error("the working folder cannot be found: " + code.message(), ".", "cd somewhere else");
  return here.string();
}

std::vector<SweepGroup> groupByStore(std::vector<PlannedSweep> sweeps) {
  std::vector<SweepGroup> out;
  for (PlannedSweep& sweep : sweeps) {
    const std::string store = fs::absolute(sweep.store).lexically_normal().string();
    auto group = std::find_if(out.begin(), out.end(), [&](const SweepGroup& one) {
      return fs::absolute(one.store).lexically_normal().string() == store;
    });
    if (group == out.end()) group = out.insert(out.end(), {sweep.store, {}});
    group->sweeps.push_back(std::move(sweep));
  }
  return out;
}

}  // namespace

std::vector<SweepGroup> groupedSweeps(const SweepProgram& program, const SweepOptions& options) {
  std::vector<SweepGroup> groups = groupByStore(planSweeps(options, program.catalogue()));
  for (const SweepGroup& group : groups) requirePlainName(tasksFolder(group.store));
  requireUtf8({{"store", options.store},
               {"descriptors", options.descriptors},
               {"folder", currentFolder()},
               {"references", options.references},
               {"slurm_options", options.slurmOptions}});
  return groups;
}

std::set<std::string> keysOf(const SweepGroup& group) {
  std::set<std::string> out;
  for (const PlannedSweep& sweep : group.sweeps)
    for (const PlannedRun& run : sweep.plan.runs) out.insert(run.key);
  return out;
}

std::set<std::string> leftOf(std::set<std::string> keys, const Facts& facts, bool retryDied) {
  std::erase_if(keys, [&](const std::string& key) {
    const auto found = facts.find(key);
    if (found == facts.end()) return false;
    return found->second.status == "done" || (found->second.diedTwice && !retryDied);
  });
  return keys;
}

std::vector<std::vector<std::string>> dealKeys(const SweepGroup& group, const std::set<std::string>& left,
                                               size_t count) {
  std::vector<std::vector<std::string>> batches;
  std::set<std::string> dealt;
  for (const PlannedSweep& sweep : group.sweeps) {
    std::vector<size_t> indices;
    for (size_t i = 0; i < sweep.plan.runs.size(); ++i) {
      const std::string& key = sweep.plan.runs[i].key;
      if (left.count(key) > 0 && dealt.insert(key).second) indices.push_back(i);
    }
    for (const Batch& batch : batchesOf(sweep.plan, indices)) {
      std::vector<std::string>& keys = batches.emplace_back();
      for (const size_t index : batch) keys.push_back(sweep.plan.runs[index].key);
    }
  }
  std::vector<std::vector<std::string>> out;
  for (const std::vector<size_t>& mine : deal(batches.size(), std::min(count, batches.size()))) {
    std::vector<std::string>& keys = out.emplace_back();
    for (const size_t batch : mine) keys.insert(keys.end(), batches[batch].begin(), batches[batch].end());
  }
  return out;
}

Submission describeSubmission(const SweepGroup& group, const SweepOptions& options) {
  Submission out;
  out.startedIn = currentFolder();
  for (const PlannedSweep& sweep : group.sweeps) {
    out.descriptors.push_back(sweep.descriptor.path);
    out.experiments.push_back(sweep.descriptor.hash);
  }
  out.store = group.store;
  out.root = fs::absolute(options.root).lexically_normal().string();
  out.references = options.references;
  out.device = options.device;
  out.array = options.array;
  out.slurmOptions = options.slurmOptions;
  out.report = !options.noReport;
  return out;
}

void enterPlans(const SweepGroup& group) {
  makeFolderOf(group.store);
  store::Store results(group.store, store::Access::ReadWrite);
  for (const PlannedSweep& sweep : group.sweeps) enterExperiment(sweep.descriptor, sweep.plan, results);
}

int endGroup(const SweepGroup& group, const std::set<std::string>& now, const std::string& program,
             bool report, const std::string& note, const SweepOutput& output) {
  int exitCode = kExitSuccess;
  for (const PlannedSweep& sweep : group.sweeps) {
    store::Store results(sweep.store, store::Access::ReadWrite);
    const int64_t experiment = enterExperiment(sweep.descriptor, sweep.plan, results);
    const Facts facts = factsOf(results);
    SweepTally tally;
    std::set<std::string> devices;
    for (const PlannedRun& run : sweep.plan.runs) {
      ++tally.planned;
      const auto found = facts.find(run.key);
      if (found == facts.end() || found->second.status == "running") {
        ++tally.left;
        continue;
      }
      devices.insert(found->second.device);
      if (found->second.status == "failed") {
        ++tally.failed;
        output.say(fmt::format("failed: {}: {}", describe(run), found->second.error));
      } else {
        ++(now.count(run.key) > 0 ? tally.done : tally.skipped);
      }
    }
    SweepEnd end;
    end.program = program;
    end.report = report;
    end.note = note;
    if (devices.size() == 1) end.device = *devices.begin();
    if (devices.size() > 1)
      output.say(fmt::format("measured on {} devices, whose times do not compare: {}", devices.size(),
                             join({devices.begin(), devices.end()}, "; ")));
    exitCode = std::max(exitCode, endSweep(sweep, tally, experiment, results, end, output));
    if (tally.left > 0) exitCode = std::max(exitCode, kExitFailedRuns);
  }
  return exitCode;
}

std::string describeCount(size_t number, const std::string& word) {
  return fmt::format("{} {}{}", number, word, number == 1 ? "" : "s");
}

}  // namespace limen::experiments
