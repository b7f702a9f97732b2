// SPDX-License-Identifier: BSD-3-Clause
// Tasks of a sweep that is shared out: what measures, and what keeps that alive.
#include "experiments/tasks.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "experiments/base/child_process.h"
#include "experiments/base/cores.h"
#include "experiments/base/error.h"
#include "experiments/gathering.h"
#include "experiments/shared_sweep.h"

namespace limen::experiments {
namespace {

namespace fs = std::filesystem;

/// A task's process is started again this often without any run finished in between.
constexpr int kStartsWithoutProgress = 4;

}  // namespace

void enterFolder(const std::string& folder) {
  if (chdir(folder.c_str()) != 0)
    throw Error("cannot be entered", folder, "the sweep was submitted from there; put it back");
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

bool Restarts::operator()() {
  const size_t finished = finishedIn(store_);
  vain_ = finished > finished_ ? 0 : vain_ + 1;
  finished_ = finished;
  return vain_ < kStartsWithoutProgress;
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
  // Tasks on one host share everything; each begins elsewhere.
  const bool alone = !submission.array.empty();
  for (int task = alone ? options.jobTask : 1; task <= (alone ? options.jobTask : submission.tasks); ++task)
    for (const std::string& key : taskKeys(submission, task)) share.keys.insert(key);
  if (!alone) share.queueFile = queueFile(submission);
  share.task = options.jobTask;
  share.tasks = submission.tasks;
  share.progressFile = progressFile(submission, options.jobTask);
  out.share = std::move(share);
  if (!alone) shareCores(submission.tasks);
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

}  // namespace limen::experiments
