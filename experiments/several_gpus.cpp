// SPDX-License-Identifier: BSD-3-Clause
// limen sweep --gpus.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>
#include <sstream>

#include "experiments/base/child_process.h"
#include "experiments/base/claim_owner.h"
#include "experiments/base/error.h"
#include "experiments/base/file_lock.h"
#include "experiments/device_process.h"
#include "experiments/progress_line.h"
#include "experiments/shared_sweep.h"
#include "experiments/sweep_group.h"
#include "experiments/tasks.h"

namespace limen::experiments {
namespace {

std::vector<int> chooseAll(const std::vector<SweepDevice>& devices) {
  std::vector<int> out;
  for (size_t i = 0; i < devices.size(); ++i) {
    if (devices[i].software) continue;
    if (!devices[i].assigned)
      throw Error("which of the GPUs here Slurm gave this job cannot be told", "--gpus",
                  "name them: --gpus 0,2; limen sweep --list devices shows what is there");
    if (*devices[i].assigned) out.push_back(static_cast<int>(i));
  }
  return out;
}

std::vector<int> chooseNamed(size_t devices, const std::string& which) {
  std::vector<int> out;
  std::istringstream stream(which + ",");
  for (std::string word; std::getline(stream, word, ',');) {
    int index = -1;
    const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), index);
    if (code != std::errc{} || end != word.data() + word.size() || index < 0)
      throw Error("'" + word + "' is not the index of a GPU", "--gpus", "give all, or indices: --gpus 0,2");
    if (static_cast<size_t>(index) >= devices)
      throw Error(fmt::format("there is no device {} to measure on", index), "--gpus",
                  "limen sweep --list devices shows what is there");
    if (std::find(out.begin(), out.end(), index) != out.end())
      throw Error(fmt::format("device {} is named twice", index), "--gpus",
                  "a GPU measures one run at a time");
    out.push_back(index);
  }
  return out;
}

struct ChosenDevice {
  int index = 0;
  std::string name;
  std::optional<DeviceProcess> process;  ///< none once it was told to measure
};

std::vector<ChosenDevice> startOn(const SweepProgram& program, const std::string& which) {
  std::vector<SweepDevice> devices;
  if (program.unopenedDevices) devices = program.unopenedDevices();
  std::vector<ChosenDevice> out;
  for (const int index : which == "all" ? chooseAll(devices) : chooseNamed(devices.size(), which))
    out.push_back({index, "", DeviceProcess(index)});
  return out;
}

/// Waits for their names. Of all devices those count that are GPUs with what sweeps need.
void waitUntilOpen(std::vector<ChosenDevice>& devices, bool all) {
  for (ChosenDevice& device : devices) {
    try {
      const SweepDevice& open = device.process->device();
      if (!all || !open.software) device.name = open.name;
    } catch (const Error&) {
      if (!all) throw;
    }
  }
  std::vector<ChosenDevice> usable;
  for (ChosenDevice& device : devices)
    if (!device.name.empty()) usable.push_back(std::move(device));
  devices = std::move(usable);
  if (devices.empty())
    throw Error("there is no GPU", "--gpus", "limen sweep --list devices shows what is there");
}

int sweepGroup(const SweepGroup& group, std::vector<ChosenDevice>& devices, const SweepProgram& program,
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
    for (const ChosenDevice& device : devices) names.insert(device.name);
    const Facts facts = factsOf(store::Store(group.store, store::Access::ReadOnly), names);
    left = leftOf(std::move(left), facts, options.retryDied);
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
                           describeCount(keysOf(group).size(), "run"), describeCount(keys.size(), "GPU"),
                           submission.folder));
    std::vector<KeptProgram> programs;
    std::vector<Restarts> restarts;
    for (size_t i = 0; i < keys.size(); ++i) {
      const int task = static_cast<int>(i) + 1;
      ChosenDevice& on = devices[i];
      programs.push_back({measuringCall(submission, task, std::to_string(on.index)),
                          taskLog(submission, task), on.process ? on.process->measure(submission, task) : 0});
      on.process.reset();
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
                            devices[i].index, statuses[i], taskLog(submission, static_cast<int>(i) + 1));
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

int sweepOnDevices(const SweepProgram& program, const SweepOptions& options) {
  std::vector<ChosenDevice> devices = startOn(program, options.gpus);
  const std::vector<SweepGroup> groups = groupedSweeps(program, options);
  waitUntilOpen(devices, options.gpus == "all");
  int exitCode = kExitSuccess;
  bool stopped = false;
  for (const SweepGroup& group : groups) {
    exitCode = std::max(exitCode, sweepGroup(group, devices, program, options, stopped));
    if (stopped || (options.failFast && exitCode != kExitSuccess)) break;
  }
  return exitCode;
}

}  // namespace limen::experiments
