// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/gathering.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <system_error>

#include "experiments/base/child_process.h"
#include "experiments/base/claim_owner.h"
#include "experiments/base/error.h"
#include "experiments/base/replace_file.h"
#include "experiments/slurm.h"

namespace limen::experiments {
namespace {

namespace fs = std::filesystem;

std::string lowered(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

int rankOf(const std::string& status) { return status == "done" ? 2 : status == "failed" ? 1 : 0; }

Facts collect(const store::Store& results, const std::function<bool(const std::string&)>& wanted) {
  const std::string died = store::Store::diedTwice("");
  Facts out;
  for (store::RunState& state : results.runStates()) {
    if (!wanted(state.device)) continue;
    RunFacts& facts = out[state.key];
    if (!facts.status.empty() && rankOf(facts.status) >= rankOf(state.status)) continue;
    facts.diedTwice = state.status == "failed" && state.error.starts_with(died);
    facts.status = std::move(state.status);
    facts.device = std::move(state.device);
    facts.error = std::move(state.error);
  }
  return out;
}

std::string markOf(const Submission& submission, const char* name) { return submission.folder + "/" + name; }

/// Whether a task said within the hour, after which claims lapse as well, that it is at work.
bool sawProgress(const Submission& submission) {
  for (int task = 1; task <= submission.tasks; ++task) {
    std::error_code code;
    const fs::file_time_type at = fs::last_write_time(progressFile(submission, task), code);
    if (!code && fs::file_time_type::clock::now() - at < std::chrono::hours(1)) return true;
  }
  return false;
}

constexpr const char* kMerged = "merged";
constexpr const char* kEnded = "ended";

}  // namespace

Facts factsOf(const store::Store& results, const std::string& device) {
  // An index means another device on each host.
  const bool index = device.find_first_not_of("0123456789") == std::string::npos;
  const std::string part = index ? "" : lowered(device);
  return collect(results,
                 [&](const std::string& name) { return lowered(name).find(part) != std::string::npos; });
}

Facts factsOf(const store::Store& results, const std::set<std::string>& devices) {
  return collect(results, [&](const std::string& name) { return devices.count(name) > 0; });
}

size_t finishedIn(const std::string& store) {
  if (!fs::exists(store) || store::isUnwritten(store)) return 0;
  size_t out = 0;
  for (const store::RunState& state : store::Store(store, store::Access::ReadOnly).runStates())
    out += state.status != "running" ? 1 : 0;
  return out;
}

bool isActive(const Submission& submission) {
  if (submission.array.empty()) {
    const OwnerState owner = stateOfOwner(submission.owner);
    return owner == OwnerState::Alive || (owner == OwnerState::Unknown && sawProgress(submission));
  }
  const std::optional<std::vector<SlurmTask>> tasks = listJobs(submission);
  if (!tasks) {
    if (findProgram("squeue").empty()) return false;
    throw Error("Slurm does not answer, so that nobody knows whether tasks are still at work",
                submission.folder, "try again when squeue works");
  }
  return std::any_of(tasks->begin(), tasks->end(), [](const SlurmTask& task) { return isActive(task); });
}

std::vector<Submission> activeSubmissions(const std::string& store) {
  std::vector<Submission> out;
  for (Submission& submission : readSubmissions(store))
    if (!fs::exists(markOf(submission, kMerged)) && isActive(submission))
      out.push_back(std::move(submission));
  return out;
}

std::set<std::string> keysInQueue(const std::string& store) {
  std::set<std::string> out;
  for (const Submission& submission : activeSubmissions(store))
    for (int task = 1; task <= submission.tasks; ++task)
      for (std::string& key : taskKeys(submission, task)) out.insert(std::move(key));
  return out;
}

void gatherSubmission(const Submission& submission, const std::string& store, const SweepOutput& output) {
  store::Store results(store, store::Access::ReadWrite);
  int64_t added = 0;
  bool whole = true;
  for (int task = 1; task <= submission.tasks; ++task) {
    const std::string path = taskStore(submission, task);
    try {
      if (!fs::exists(path) || store::isUnwritten(path)) continue;
      // Nobody but the task writes its files, and it replaces them: they need not be on the disk twice.
      added += results.merge(store::Store(path, store::Access::ReadOnly), store::Store::Files::Shared);
    } catch (const Error& error) {
      reportSweepFailure(error);
      whole = false;
    }
  }
  output.say(fmt::format("{}: {} runs added from {} tasks", store, added, submission.tasks));
  if (whole) replaceFile(markOf(submission, kMerged), fmt::format("{} runs\n", added));
}

Gathered gather(const std::string& store, const SweepOutput& output) {
  Gathered out;
  for (const Submission& submission : readSubmissions(store)) {
    const bool active = !fs::exists(markOf(submission, kEnded)) && isActive(submission);
    if (!active && !fs::exists(markOf(submission, kMerged))) gatherSubmission(submission, store, output);
    out.unended = !active && !fs::exists(markOf(submission, kEnded));
  }
  return out;
}

void markEnded(const Submission& submission, int exitCode) {
  replaceFile(markOf(submission, kEnded), fmt::format("{}\n", exitCode));
}

bool isEnded(const Submission& submission) { return fs::exists(markOf(submission, kEnded)); }

std::string progressFile(const Submission& submission, int task) {
  return submission.folder + "/task_" + std::to_string(task) + ".progress";
}

}  // namespace limen::experiments
