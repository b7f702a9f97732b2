// SPDX-License-Identifier: BSD-3-Clause
// limen submit, and the job that merges.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "experiments/base/environment.h"
#include "experiments/base/error.h"
#include "experiments/base/file_lock.h"
#include "experiments/shared_sweep.h"
#include "experiments/slurm.h"
#include "experiments/sweep_group.h"
#include "experiments/tasks.h"

namespace limen::experiments {
namespace {

namespace fs = std::filesystem;

/// Runs that tasks leave behind are submitted this often in all.
constexpr int kAttempts = 3;

struct Jobs {
  SlurmJob array, merge;
};

/// Writes what the tasks need and the scripts.
Jobs prepare(Submission& submission, const std::vector<std::vector<std::string>>& keys) {
  writeSubmission(submission, keys);
  Jobs jobs{arrayJob(submission), mergeJob(submission, "ARRAY")};
  writeScript(jobs.array);
  writeScript(jobs.merge);
  return jobs;
}

void submitPrepared(const Submission& submission, const Jobs& jobs, const std::string& summary,
                    const SweepOutput& output) {
  const std::string array = submitJob(jobs.array);
  std::string merge;
  try {
    merge = submitJob(mergeJob(submission, array));
  } catch (const Error& error) {
    throw Error(fmt::format("the tasks are in the queue as job {}, but not the job that merges: {}", array,
                            error.what()),
                submission.store, "when they have ended, the same limen submit merges");
  }
  output.say(fmt::format("{}: {} in job {}, merged by job {}; limen status {} shows how far they are",
                         submission.store, summary, array, merge, quoteCommand({submission.store})));
  if (output.json())
    output.printJson({{"store", submission.store},
                      {"array_job", array},
                      {"merge_job", merge},
                      {"tasks", submission.tasks},
                      {"folder", submission.folder}});
}

/// Tasks that no job will merge, since their submission was killed halfway or that job cancelled, get one
/// now.
void submitMissingMerges(const std::string& store, const SweepOutput& output) {
  for (const Submission& submission : activeSubmissions(store)) {
    if (submission.array.empty()) continue;
    std::string array;
    bool hasMerge = false;
    for (const SlurmTask& task : listJobs(submission).value_or(std::vector<SlurmTask>())) {
      if (task.index > 0) array = task.array;
      hasMerge = hasMerge || (task.merge && isActive(task));
    }
    if (hasMerge || array.empty()) continue;
    const SlurmJob job = mergeJob(submission, array);
    writeScript(job);
    output.say(fmt::format("{}: job {} is merged by job {}", store, array, submitJob(job)));
  }
}

void printScript(const SlurmJob& job, const SweepOutput& output) {
  output.say(fmt::format("# {}\n{}\n{}\n", job.scriptPath, job.script, quoteCommand(job.call)));
}

int submitGroup(const SweepGroup& group, const SweepProgram& program, const SweepOptions& options) {
  const SweepOutput output(options);
  const std::string folder = tasksFolder(group.store);
  std::set<std::string> left = keysOf(group);
  const size_t planned = left.size();
  size_t queued = 0;
  bool unended = false;
  std::optional<FileLock> lock;
  if (!options.dryRun) {
    makeFolderOf(folder + "/lock");
    lock.emplace(folder + "/lock");
    enterPlans(group);
    unended = gather(group.store, output).unended;
    submitMissingMerges(group.store, output);
  }
  if (fs::exists(group.store) && !store::isUnwritten(group.store)) {
    const Facts facts = factsOf(store::Store(group.store, store::Access::ReadOnly), options.device);
    left = leftOf(std::move(left), facts, options.retryDied);
  }
  for (const std::string& key : keysInQueue(group.store)) queued += left.erase(key);
  const auto tasks = static_cast<size_t>(readArray(options.array).first);
  const std::vector<std::vector<std::string>> keys = dealKeys(group, left, tasks);
  if (left.empty()) {
    output.say(fmt::format("{}: nothing to submit: {} done{}", group.store,
                           describeCount(planned - queued, "run"),
                           queued > 0 ? fmt::format(", {} in the queue", queued) : ""));
    if (output.json()) output.printJson({{"store", group.store}, {"tasks", 0}, {"queued", queued}});
    // Else the job that merges ended before it could say what the sweep came to.
    if (!unended || queued > 0) return kExitSuccess;
    const int exitCode = endGroup(group, keysOf(group), program.name, !options.noReport, "", output);
    if (!options.dryRun) markEnded(readSubmissions(group.store).back(), exitCode);
    return exitCode;
  }
  Submission submission = describeSubmission(group, options);
  const std::string summary = fmt::format("{} of {} in {}", left.size(), describeCount(planned, "run"),
                                          describeCount(keys.size(), "task"));
  if (options.dryRun) {
    submission.folder = folder + "/NEXT";
    submission.name = "limen_NAME";
    submission.tasks = static_cast<int>(keys.size());
    printScript(arrayJob(submission), output);
    printScript(mergeJob(submission, "ARRAY"), output);
    output.say(fmt::format("{}: {}", group.store, summary));
    if (output.json())
      output.printJson({{"store", group.store}, {"tasks", keys.size()}, {"runs", left.size()}});
    return kExitSuccess;
  }
  const Jobs jobs = prepare(submission, keys);
  try {
    requireSlurm();
    submitPrepared(submission, jobs, summary, output);
  } catch (const Error&) {
    printScript(jobs.array, output);
    printScript(jobs.merge, output);
    throw;
  }
  return kExitSuccess;
}

/// What tasks of a submission came to that did not end well, with their logs.
std::vector<std::string> troubles(const Submission& submission, const std::vector<SlurmTask>& tasks) {
  std::vector<std::string> out;
  for (const SlurmTask& task : tasks)
    if (task.index > 0 && !isActive(task) && task.state != "COMPLETED")
      out.push_back(fmt::format("task {} ended as {}{}; its log: {}", task.index, task.state,
                                task.nodes.empty() ? "" : " on " + task.nodes,
                                taskLog(submission, task.index)));
  return out;
}

bool wasCancelled(const std::vector<SlurmTask>& tasks) {
  return std::any_of(tasks.begin(), tasks.end(), [](const SlurmTask& task) {
    return task.index > 0 && task.state.starts_with("CANCELLED");
  });
}

}  // namespace

int submitSweeps(const SweepProgram& program, const SweepOptions& options) {
  checkSlurmOptions(options.slurmOptions);
  readArray(options.array);
  const std::vector<SweepGroup> groups = groupedSweeps(program, options);
  for (const SweepGroup& group : groups) requireSlurmName(tasksFolder(group.store));
  int exitCode = kExitSuccess;
  for (const SweepGroup& group : groups) exitCode = std::max(exitCode, submitGroup(group, program, options));
  return exitCode;
}

int mergeTasks(const SweepProgram& program, const SweepOptions& given) {
  const Submission submission = readSubmission(given.jobFolder);
  enterFolder(submission.startedIn);
  const SweepOptions options = optionsOf(submission, given);
  const SweepOutput output(options);
  const FileLock lock(tasksFolder(submission.store) + "/lock");
  const std::vector<SlurmTask> tasks = listJobs(submission).value_or(std::vector<SlurmTask>());
  gatherSubmission(submission, submission.store, output);
  const std::vector<std::string> ended = troubles(submission, tasks);
  for (const std::string& trouble : ended) output.say(trouble);
  std::vector<SweepGroup> groups = groupedSweeps(program, options);
  SweepGroup& group = groups.at(0);
  std::vector<std::string> hashes;
  for (const PlannedSweep& sweep : group.sweeps) hashes.push_back(sweep.descriptor.hash);
  if (hashes != submission.experiments)
    throw Error("the descriptor was changed after it was submitted; what was measured is merged",
                submission.descriptors[0], "limen submit again submits what is new");

  std::set<std::string> now, left;
  for (int task = 1; task <= submission.tasks; ++task)
    for (std::string& key : taskKeys(submission, task)) now.insert(std::move(key));
  const Facts facts = factsOf(store::Store(submission.store, store::Access::ReadOnly), submission.device);
  for (const std::string& key : now) {
    const auto found = facts.find(key);
    if (found == facts.end() || found->second.status == "running") left.insert(key);
  }
  // This job may be its own second start, and have submitted them before.
  submitMissingMerges(submission.store, output);
  const size_t before = left.size();
  for (const std::string& key : keysInQueue(submission.store)) left.erase(key);
  if (left.empty() && before > 0) {
    output.say(fmt::format("{} left behind are in the queue again", describeCount(before, "run")));
    return kExitSuccess;
  }
  std::string note;
  if (!left.empty()) {
    const bool cancelled = wasCancelled(tasks);
    if (!cancelled && submission.attempt < kAttempts) {
      Submission next = submission;
      ++next.attempt;
      const std::vector<std::vector<std::string>> keys =
          dealKeys(group, left, static_cast<size_t>(readArray(next.array).first));
      const Jobs jobs = prepare(next, keys);
      submitPrepared(
          next, jobs,
          fmt::format("{} left behind, again in {} (attempt {} of {})", describeCount(left.size(), "run"),
                      describeCount(keys.size(), "task"), next.attempt, kAttempts),
          output);
      return kExitSuccess;
    }
    note = cancelled ? "tasks were cancelled; limen submit goes on where they stopped"
                     : fmt::format("{} left after {} attempts; limen submit tries again",
                                   describeCount(left.size(), "run"), submission.attempt);
  }
  for (const std::string& trouble : ended) note += (note.empty() ? "" : "\n") + trouble;
  const int exitCode = endGroup(group, now, program.name, submission.report, note, output);
  markEnded(submission, exitCode);
  return exitCode;
}

}  // namespace limen::experiments
