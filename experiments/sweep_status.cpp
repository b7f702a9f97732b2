// SPDX-License-Identifier: BSD-3-Clause
// limen status: Slurm's queue and the stores together.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "experiments/base/text.h"
#include "experiments/console.h"
#include "experiments/gathering.h"
#include "experiments/shared_sweep.h"
#include "experiments/slurm.h"
#include "experiments/task_progress.h"

namespace limen::experiments {
namespace {

namespace fs = std::filesystem;

constexpr size_t kFailuresShown = 10;

struct Status {
  size_t planned = 0, done = 0, running = 0, failed = 0, left = 0;
  std::optional<double> secondsLeft;
  std::vector<std::string> failures, notes;
};

/// What the store of a sweep says; runs that tasks at work have not handed over are left.
void readStore(const std::string& store, Status& status, std::set<std::string>& open) {
  const store::Store results(store, store::Access::ReadOnly);
  const Facts facts = factsOf(results);
  std::set<std::string> seen;
  for (const store::Experiment& experiment : results.experiments())
    for (const store::PlanEntry& entry : results.plan(experiment.id)) {
      if (!seen.insert(entry.key).second) continue;
      ++status.planned;
      const auto found = facts.find(entry.key);
      if (found != facts.end() && found->second.status == "done") {
        ++status.done;
      } else if (found != facts.end() && found->second.status == "failed") {
        ++status.failed;
        status.failures.push_back(entry.technique + (entry.label.empty() ? "" : " " + entry.label) + ", " +
                                  entry.scene + ": " + found->second.error);
        open.insert(entry.key);
      } else {
        if (found != facts.end()) ++status.running;
        open.insert(entry.key);
      }
    }
}

std::string countStates(const std::vector<SlurmTask>& tasks, bool merge) {
  std::map<std::string, size_t> counts;
  std::string reason;
  for (const SlurmTask& task : tasks) {
    if (task.merge != merge) continue;
    ++counts[task.state];
    if (task.state == "PENDING" && task.reason != "None") reason = task.reason;
  }
  std::vector<std::string> parts;
  for (const auto& [state, number] : counts)
    parts.push_back(merge ? state : fmt::format("{} {}", number, state));
  return join(parts) + (reason.empty() ? "" : " (" + reason + ")");
}

/// Adds what the tasks of a submission at work have done so far.
void readTasks(const Submission& submission, const std::vector<SlurmTask>& tasks,
               const std::set<std::string>& open, Status& status) {
  size_t left = 0, workers = 0, timed = 0;
  double seconds = 0.0;
  for (int task = 1; task <= submission.tasks; ++task) {
    const std::vector<std::string> keys = taskKeys(submission, task);
    const auto mine = static_cast<size_t>(
        std::count_if(keys.begin(), keys.end(), [&](const std::string& key) { return open.count(key) > 0; }));
    const bool atWork =
        submission.array.empty() || std::any_of(tasks.begin(), tasks.end(), [&](const SlurmTask& one) {
          return one.index == task && one.state.starts_with("RUNNING");
        });
    workers += atWork ? 1 : 0;
    const std::optional<TaskProgress> progress = readProgress(progressFile(submission, task));
    if (!progress || mine == 0) {
      left += mine;
      continue;
    }
    const size_t finished = std::min(mine, progress->done + progress->failed);
    status.done += std::min(finished, progress->done);
    status.failed += finished - std::min(finished, progress->done);
    if (atWork) status.running += std::min(progress->holding, mine - finished);
    left += mine - finished;
    status.failures.insert(status.failures.end(), progress->failures.begin(), progress->failures.end());
    if (progress->secondsEach > 0.0) seconds += progress->secondsEach, ++timed;
  }
  if (timed > 0 && workers > 0 && left > 0)
    status.secondsLeft =
        seconds / static_cast<double>(timed) * static_cast<double>(left) / static_cast<double>(workers);
}

Status statusOf(const std::string& store) {
  Status status;
  std::set<std::string> open;
  readStore(store, status, open);
  const std::vector<Submission> submissions = readSubmissions(store);
  for (const Submission& submission : submissions) {
    const bool last = &submission == &submissions.back();
    const std::optional<std::vector<SlurmTask>> tasks = listJobs(submission);
    const bool active = tasks && isActive(submission);
    if (active) readTasks(submission, *tasks, open, status);
    if (!active && !last) continue;
    if (!tasks) {
      status.notes.push_back("Slurm does not answer; what tasks have not handed over is not known");
    } else if (!tasks->empty()) {
      status.notes.push_back(fmt::format("tasks: {}; merging: {}; logs in {}", countStates(*tasks, false),
                                         countStates(*tasks, true), submission.folder));
      for (const SlurmTask& task : *tasks)
        if (task.index > 0 && !isActive(task) && task.state != "COMPLETED")
          status.notes.push_back(fmt::format("task {}: {}{}; its log: {}", task.index, task.state,
                                             task.nodes.empty() ? "" : " on " + task.nodes,
                                             taskLog(submission, task.index)));
    }
    if (last && !active && !isEnded(submission))
      status.notes.push_back("its tasks have ended but the sweep has not: the same limen submit goes on");
  }
  status.left = status.planned - status.done - status.running - status.failed;
  return status;
}

std::string storeOf(const std::string& name) {
  const std::string extension = fs::path(name).extension().string();
  if (extension == ".yaml" || extension == ".yml")
    return "results/" + fs::path(name).stem().string() + ".sqlite";
  return name;
}

}  // namespace

int showStatus(const SweepOptions& options) {
  const SweepOutput output(options);
  for (const std::string& name : options.shown) {
    const std::string store = storeOf(name);
    const Status status = statusOf(store);
    std::string line = fmt::format("{}: {} planned, {} done, {} running, {} failed, {} left", store,
                                   status.planned, status.done, status.running, status.failed, status.left);
    if (status.secondsLeft) line += "; about " + describeDuration(*status.secondsLeft) + " to go";
    output.say(line);
    for (const std::string& note : status.notes) output.say("  " + note);
    for (size_t i = 0; i < std::min(kFailuresShown, status.failures.size()); ++i)
      output.say("  failed: " + status.failures[i]);
    if (status.failures.size() > kFailuresShown)
      output.say(fmt::format("  and {} more", status.failures.size() - kFailuresShown));
    if (options.json)
      output.printJson(
          {{"store", store},
           {"planned", status.planned},
           {"done", status.done},
           {"running", status.running},
           {"failed", status.failed},
           {"left", status.left},
           {"seconds_left", status.secondsLeft ? nlohmann::json(*status.secondsLeft) : nlohmann::json()},
           {"failures", status.failures},
           {"notes", status.notes}});
  }
  return kExitSuccess;
}

}  // namespace limen::experiments
