// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/device_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>

#include "experiments/base/error.h"
#include "experiments/shared_sweep.h"

namespace limen::experiments {
namespace {

/// Standard input from nowhere, standard output and errors to the end of a file.
void redirectOutput(const std::string& log) {
  const int in = open("/dev/null", O_RDONLY | O_CLOEXEC);
  const int out = open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (out < 0) throw Error("cannot be written", log, "check permissions and free space");
  std::cout.flush();
  dup2(in, STDIN_FILENO);
  dup2(out, STDOUT_FILENO);
  dup2(out, STDERR_FILENO);
  close(in);
  close(out);
}

}  // namespace

DeviceProcess::DeviceProcess(int device)
    : index_(device),
      process_({ownProgram(), "job", "stand_by", fmt::format("--parent={}", getpid()),
                fmt::format("--device={}", device)}) {}

const SweepDevice& DeviceProcess::device() {
  if (device_) return *device_;
  const nlohmann::json said = nlohmann::json::parse(process_.read().value_or(""), nullptr, false);
  if (!said.is_object() || !said.contains("name"))
    throw Error(fmt::format("there is no device {} to measure on{}", index_,
                            said.is_object() ? ": " + said.value("error", "") : ""),
                "--gpus", "limen sweep --list devices shows what is there");
  device_ = SweepDevice{said.at("name"), said.at("software")};
  return *device_;
}

pid_t DeviceProcess::measure(const Submission& submission, int task) {
  const nlohmann::json order = {{"folder", submission.folder}, {"task", task}};
  return process_.write(order.dump()) ? process_.release() : 0;
}

std::optional<SweepOptions> standBy(const SweepProgram& program, const SweepOptions& options) {
  endWithParent(options.jobParent);
  setenv("LIMEN_EGL_DEVICE", options.device.c_str(), 1);
  nlohmann::json said;
  try {
    const SweepDevice device = program.openDevice();
    said = {{"name", device.name}, {"software", device.software}};
  } catch (const Error& error) {
    said = {{"error", error.message()}};
  }
  std::cout << said.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << std::endl;
  std::string line;
  if (!said.contains("name") || !std::getline(std::cin, line)) return std::nullopt;
  const nlohmann::json order = nlohmann::json::parse(line);
  SweepOptions out = options;
  out.jobVerb = "measure";
  order.at("folder").get_to(out.jobFolder);
  order.at("task").get_to(out.jobTask);
  redirectOutput(taskLog(readSubmission(out.jobFolder), out.jobTask));
  return out;
}

}  // namespace limen::experiments
