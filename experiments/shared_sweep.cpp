// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/shared_sweep.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <system_error>
#include <unordered_map>

#include "experiments/base/child_process.h"
#include "experiments/base/claim_owner.h"
#include "experiments/base/environment.h"
#include "experiments/base/file_lock.h"
#include "experiments/base/interrupt.h"
#include "experiments/base/printable.h"
#include "experiments/base/replace_file.h"
#include "experiments/base/text.h"
#include "experiments/gathering.h"
#include "experiments/progress_line.h"
#include "experiments/shares.h"
#include "experiments/slurm.h"
#include "experiments/submission.h"
#include "experiments/task_progress.h"

namespace limen::experiments {
namespace {

namespace fs = std::filesystem;

/// Runs that tasks leave behind are submitted this often in all.
constexpr int kAttempts = 3;
/// A task's process is started again this often without any run finished in between.
constexpr int kStartsWithoutProgress = 4;

std::string currentFolder() {
  std::error_code code;
  const fs::path here = fs::current_path(code);
  if (code) throw Error("the working folder cannot be found: " + code.message(), ".", "cd somewhere else");
  return here.string();
}

void enterFolder(const std::string& folder) {
  if (chdir(folder.c_str()) != 0)
    throw Error("cannot be entered", folder, "the sweep was submitted from there; put it back");
}

/// The sweeps of one store, which are shared out together.
struct Group {
  std::string store;
  std::vector<PlannedSweep> sweeps;
};

std::vector<Group> groupByStore(std::vector<PlannedSweep> sweeps) {
  std::vector<Group> out;
  for (PlannedSweep& sweep : sweeps) {
    const std::string store = fs::absolute(sweep.store).lexically_normal().string();
    auto group = std::find_if(out.begin(), out.end(), [&](const Group& one) {
      return fs::absolute(one.store).lexically_normal().string() == store;
    });
    if (group == out.end()) group = out.insert(out.end(), {sweep.store, {}});
    group->sweeps.push_back(std::move(sweep));
  }
  return out;
}

/// Nothing is written before all of this is known to be good.
std::vector<Group> groupedSweeps(const SweepProgram& program, const SweepOptions& options) {
  std::vector<Group> groups = groupByStore(planSweeps(options, program.catalogue()));
  for (const Group& group : groups) requirePlainName(tasksFolder(group.store));
  requireUtf8({{"store", options.store},
               {"descriptors", options.descriptors},
               {"folder", currentFolder()},
               {"references", options.references},
               {"slurm_options", options.slurmOptions}});
  return groups;
}

/// Keys for each task: batches of what is left, dealt to at most `count` tasks.
std::vector<std::vector<std::string>> dealKeys(const Group& group, const std::set<std::string>& left,
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

Submission describeSubmission(const Group& group, const SweepOptions& options) {
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

bool isLeft(const RunFacts& facts, bool retryDied) {
  if (facts.status == "done") return false;
  return retryDied || !facts.diedTwice;
}

std::set<std::string> keysOf(const Group& group) {
  std::set<std::string> out;
  for (const PlannedSweep& sweep : group.sweeps)
    for (const PlannedRun& run : sweep.plan.runs) out.insert(run.key);
  return out;
}

std::string count(size_t number, const std::string& word) {
  return fmt::format("{} {}{}", number, word, number == 1 ? "" : "s");
}

/// Expectations, reports and summaries of a group whose runs are all in its store. `now` are the keys that
/// were measured for this call.
int endGroup(const Group& group, const std::set<std::string>& now, const std::string& program, bool report,
             const std::string& note, const SweepOutput& output) {
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

/// Puts the whole plans into the store, so that it knows what is missing.
void enterPlans(const Group& group) {
  makeFolderOf(group.store);
  store::Store results(group.store, store::Access::ReadWrite);
  for (const PlannedSweep& sweep : group.sweeps) enterExperiment(sweep.descriptor, sweep.plan, results);
}

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

void printScript(const SlurmJob& job, const SweepOutput& output) {
  output.say(fmt::format("# {}\n{}\n{}\n", job.scriptPath, job.script, quoteCommand(job.call)));
}

int submitGroup(const Group& group, const SweepProgram& program, const SweepOptions& options) {
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
  }
  if (fs::exists(group.store) && !store::isUnwritten(group.store)) {
    const Facts facts = factsOf(store::Store(group.store, store::Access::ReadOnly), options.device);
    std::erase_if(left, [&](const std::string& key) {
      const auto found = facts.find(key);
      return found != facts.end() && !isLeft(found->second, options.retryDied);
    });
  }
  for (const std::string& key : keysInQueue(group.store)) queued += left.erase(key);
  const auto tasks = static_cast<size_t>(readArray(options.array).first);
  const std::vector<std::vector<std::string>> keys = dealKeys(group, left, tasks);
  if (left.empty()) {
    output.say(fmt::format("{}: nothing to submit: {} done{}", group.store, count(planned - queued, "run"),
                           queued > 0 ? fmt::format(", {} in the queue", queued) : ""));
    if (output.json()) output.printJson({{"store", group.store}, {"tasks", 0}, {"queued", queued}});
    // Else the job that merges ended before it could say what the sweep came to.
    if (!unended || queued > 0) return kExitSuccess;
    const int exitCode = endGroup(group, keysOf(group), program.name, !options.noReport, "", output);
    if (!options.dryRun) markEnded(readSubmissions(group.store).back(), exitCode);
    return exitCode;
  }
  Submission submission = describeSubmission(group, options);
  const std::string summary =
      fmt::format("{} of {} in {}", left.size(), count(planned, "run"), count(keys.size(), "task"));
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

SweepOptions optionsOf(const Submission& submission, SweepOptions options) {
  options.descriptors = submission.descriptors;
  options.store = submission.store;
  options.root = submission.root;
  options.array = submission.array;
  options.slurmOptions = submission.slurmOptions;
  options.noReport = !submission.report;
  options.references = submission.references.empty()
                           ? (fs::path(submission.store).parent_path() / "references").string()
                           : submission.references;
  if (options.device.empty()) options.device = submission.device;
  return options;
}

std::vector<int> chooseDevices(const SweepProgram& program, const std::string& which) {
  const std::vector<SweepDevice> devices = program.devices ? program.devices() : std::vector<SweepDevice>{};
  std::vector<int> out;
  if (which == "all") {
    for (size_t i = 0; i < devices.size(); ++i)
      if (!devices[i].name.empty() && !devices[i].software) out.push_back(static_cast<int>(i));
    if (out.empty())
      throw Error("there is no GPU", "--gpus", "limen sweep --list devices shows what is there");
    return out;
  }
  std::istringstream stream(which + ",");
  for (std::string word; std::getline(stream, word, ',');) {
    int index = -1;
    const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), index);
    if (code != std::errc{} || end != word.data() + word.size() || index < 0)
      throw Error("'" + word + "' is not the index of a GPU", "--gpus", "give all, or indices: --gpus 0,2");
    if (static_cast<size_t>(index) >= devices.size() || devices[static_cast<size_t>(index)].name.empty())
      throw Error(fmt::format("there is no device {} to measure on", index), "--gpus",
                  "limen sweep --list devices shows what is there");
    if (std::find(out.begin(), out.end(), index) != out.end())
      throw Error(fmt::format("device {} is named twice", index), "--gpus",
                  "a GPU measures one run at a time");
    out.push_back(index);
  }
  return out;
}

std::vector<std::string> measuringCall(const Submission& submission, int task, const std::string& device) {
  std::vector<std::string> out = {ownProgram(),
                                  "job",
                                  "measure",
                                  submission.folder,
                                  fmt::format("--task={}", task),
                                  fmt::format("--parent={}", getpid())};
  if (!device.empty()) out.push_back("--device=" + device);
  return out;
}

/// Allows a task's process to be started again as long as runs get finished in between.
class Restarts {
 public:
  explicit Restarts(std::string store) : store_(std::move(store)) {}
  bool operator()() {
    const size_t finished = finishedIn(store_);
    vain_ = finished > finished_ ? 0 : vain_ + 1;
    finished_ = finished;
    return vain_ < kStartsWithoutProgress;
  }

 private:
  std::string store_;
  size_t finished_ = 0;
  int vain_ = 0;
};

int sweepGroup(const Group& group, const std::vector<int>& devices, const SweepProgram& program,
               const SweepOptions& options, bool& stopped) {
  const SweepOutput output(options);
  const std::string folder = tasksFolder(group.store);
  std::set<std::string> left = keysOf(group);
  std::vector<std::vector<std::string>> keys;
  Submission submission = describeSubmission(group, options);
  {
    makeFolderOf(folder + "/lock");
    const FileLock lock(folder + "/lock");
    enterPlans(group);
    gather(group.store, output);
    std::set<std::string> names;
    const std::vector<SweepDevice> all = program.devices();
    for (const int device : devices) names.insert(all[static_cast<size_t>(device)].name);
    const Facts facts = factsOf(store::Store(group.store, store::Access::ReadOnly), names);
    std::erase_if(left, [&](const std::string& key) {
      const auto found = facts.find(key);
      return found != facts.end() && !isLeft(found->second, options.retryDied);
    });
    for (const std::string& key : keysInQueue(group.store)) left.erase(key);
    keys = dealKeys(group, left, devices.size());
    if (!keys.empty()) {
      submission.owner = claimOwner();
      writeSubmission(submission, keys);
    }
  }
  std::string note;
  if (!keys.empty()) {
    for (const PlannedSweep& sweep : group.sweeps)
      output.say(fmt::format("{}: {}", sweep.descriptor.path, describeSize(sweep.descriptor, sweep.plan)));
    output.say(fmt::format("{} of {} left, on {}; logs in {}", left.size(),
                           count(keysOf(group).size(), "run"), count(keys.size(), "GPU"), submission.folder));
    std::vector<KeptProgram> programs;
    std::vector<Restarts> restarts;
    for (size_t i = 0; i < keys.size(); ++i) {
      const int task = static_cast<int>(i) + 1;
      programs.push_back(
          {measuringCall(submission, task, std::to_string(devices[i])), taskLog(submission, task)});
      restarts.emplace_back(taskStore(submission, task));
    }
    ProgressLine line(submission, left.size());
    int signal = 0;
    const std::vector<int> statuses = keepRunning(
        programs, [&](size_t index) { return restarts[index](); }, [&] { line.show(); }, &signal);
    line.end();
    for (size_t i = 0; i < statuses.size(); ++i)
      if (statuses[i] > kExitFailedRuns && signal == 0)
        note += fmt::format("{}GPU {}: its process ended with {}; its log: {}", note.empty() ? "" : "\n",
                            devices[i], statuses[i], taskLog(submission, static_cast<int>(i) + 1));
    const FileLock lock(folder + "/lock");
    gatherSubmission(submission, group.store, output);
    stopped = signal != 0;
    if (stopped) {
      output.say("interrupted; the same command resumes where it stopped");
      return 128 + signal;
    }
  }
  const int exitCode = endGroup(group, left, program.name, !options.noReport, note, output);
  if (!keys.empty()) markEnded(submission, exitCode);
  return exitCode;
}

}  // namespace

int submitSweeps(const SweepProgram& program, const SweepOptions& options) {
  checkSlurmOptions(options.slurmOptions);
  readArray(options.array);
  int exitCode = kExitSuccess;
  for (const Group& group : groupedSweeps(program, options))
    exitCode = std::max(exitCode, submitGroup(group, program, options));
  return exitCode;
}

int sweepOnDevices(const SweepProgram& program, const SweepOptions& options) {
  const std::vector<Group> groups = groupedSweeps(program, options);
  const std::vector<int> devices = chooseDevices(program, options.gpus);
  int exitCode = kExitSuccess;
  bool stopped = false;
  for (const Group& group : groups) {
    exitCode = std::max(exitCode, sweepGroup(group, devices, program, options, stopped));
    if (stopped || (options.failFast && exitCode != kExitSuccess)) break;
  }
  return exitCode;
}

SweepOptions optionsOfTask(const SweepOptions& options) {
  if (options.jobParent != 0) endWithParent(options.jobParent);
  const Submission submission = readSubmission(options.jobFolder);
  enterFolder(submission.startedIn);
  SweepOptions out = optionsOf(submission, options);
  out.command = SweepOptions::Command::Sweep;
  out.store = taskStore(submission, options.jobTask);
  out.noReport = true;
  TaskShare share;
  for (const std::string& key : taskKeys(submission, options.jobTask)) share.keys.insert(key);
  share.task = options.jobTask;
  share.tasks = submission.tasks;
  share.progressFile = progressFile(submission, options.jobTask);
  out.share = std::move(share);
  return out;
}

int keepTask(const SweepOptions& options) {
  const Submission submission = readSubmission(options.jobFolder);
  int task = options.jobTask;
  if (task == 0)
    if (const char* const index = std::getenv("SLURM_ARRAY_TASK_ID")) task = std::atoi(index);
  if (task < 1 || task > submission.tasks)
    throw Error(fmt::format("there is no task {} of {}", task, submission.tasks), "SLURM_ARRAY_TASK_ID",
                "this is started by the scripts of limen submit");
  Restarts restarts(taskStore(submission, task));
  int signal = 0;
  const int status = keepRunning(
      {{measuringCall(submission, task, options.device), ""}}, [&](size_t) { return restarts(); }, {},
      &signal)[0];
  return signal != 0 ? 128 + signal : status;
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
  std::vector<Group> groups = groupByStore(planSweeps(options, program.catalogue()));
  Group& group = groups.at(0);
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
  std::string note;
  if (!left.empty()) {
    const bool cancelled = wasCancelled(tasks);
    if (!cancelled && submission.attempt < kAttempts) {
      Submission next = submission;
      ++next.attempt;
      const std::vector<std::vector<std::string>> keys =
          dealKeys(group, left, static_cast<size_t>(readArray(next.array).first));
      const Jobs jobs = prepare(next, keys);
      submitPrepared(next, jobs,
                     fmt::format("{} left behind, again in {} (attempt {} of {})", count(left.size(), "run"),
                                 count(keys.size(), "task"), next.attempt, kAttempts),
                     output);
      return kExitSuccess;
    }
    note = cancelled ? "tasks were cancelled; limen submit goes on where they stopped"
                     : fmt::format("{} left after {} attempts; limen submit tries again",
                                   count(left.size(), "run"), submission.attempt);
  }
  for (const std::string& trouble : ended) note += (note.empty() ? "" : "\n") + trouble;
  const int exitCode = endGroup(group, now, program.name, submission.report, note, output);
  markEnded(submission, exitCode);
  return exitCode;
}

}  // namespace limen::experiments
