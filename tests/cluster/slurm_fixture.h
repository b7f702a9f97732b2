// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <signal.h>
#include <sys/stat.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <map>
#include <regex>
#include <thread>

#include "experiments/base/child_process.h"
#include "experiments/base/error.h"
#include "experiments/store/store.h"
#include "experiments/submission.h"
#include "tests/experiments/cli_fixture.h"

namespace limen::experiments {

/// A Slurm of three nodes with two processors each, for one test.
class SlurmTest : public SweepCli {
 protected:
  void SetUp() override {
    SweepCli::SetUp();
    std::string pattern = "/tmp/lslurm_XXXXXX";
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    cluster_ = pattern;
    chmod(cluster_.c_str(), 0755);  // munged insists that all may reach its socket
    setenv("SLURM_CONF", (cluster_ + "/slurm.conf").c_str(), 1);
    const ProgramOutput up = slurm({"up", cluster_, "3", "2"});
    // Not without a word: then nothing here is tested. Where its programs are (limen test installs them) it
    // must start.
    if (up.status == 3) GTEST_SKIP() << "*** Sweeps on a cluster are NOT tested: " << up.err;
    ASSERT_EQ(up.status, 0) << up.err;
  }
  void TearDown() override {
    if (HasFailure()) {
      std::cerr << "queue:\n" << runAndRead({"squeue", "-t", "all"}).out;
      for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_))
        if (entry.path().extension() == ".log")
          std::cerr << "--- " << entry.path() << "\n" << readAny(entry.path());
    }
    slurm({"down", cluster_});
    std::filesystem::remove_all(cluster_);
    SweepCli::TearDown();
  }

  static ProgramOutput slurm(std::vector<std::string> words) {
    words.insert(words.begin(), {"bash", LIMEN_SLURM});
    return runAndRead(words);
  }
  /// What there is of it: a process may end while its files are read.
  static std::string readAny(const std::filesystem::path& file) {
    std::string text;
    const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
    std::array<char, 4096> buffer{};
    for (ssize_t count = 0; (count = ::read(descriptor, buffer.data(), buffer.size())) > 0;)
      text.append(buffer.data(), static_cast<size_t>(count));
    if (descriptor >= 0) close(descriptor);
    return text;
  }

  /// Whether `condition` comes true in time.
  static bool eventually(const std::function<bool()>& condition, double seconds = 60.0) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (!condition()) {
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return true;
  }

  struct Listed {
    std::string job, name, state, node;
    int index = 0;
  };
  static std::vector<Listed> queue() {
    std::vector<Listed> out;
    std::istringstream lines(
        runAndRead({"squeue", "--noheader", "--array", "--states=all", "--format=%A|%K|%T|%N|%j"}).out);
    for (std::string line; std::getline(lines, line);) {
      std::array<std::string, 5> field;
      std::istringstream fields(line);
      for (std::string& one : field) std::getline(fields, one, '|');
      out.push_back({field[0], field[4], field[2], field[3], std::atoi(field[1].c_str())});
    }
    return out;
  }
  static bool isOver(const Listed& job) {
    return std::regex_match(job.state, std::regex("COMPLETED|FAILED|CANCELLED|NODE_FAIL|TIMEOUT"));
  }
  static bool allOver() {
    const std::vector<Listed> jobs = queue();
    return !jobs.empty() && std::all_of(jobs.begin(), jobs.end(), isOver);
  }

  /// Ids of the processes whose command line holds these words in a row: kills them as the kernel does that
  /// has no memory left.
  static std::vector<pid_t> processes(const std::string& words) {
    std::vector<pid_t> out;
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
      const pid_t id = std::atoi(entry.path().filename().c_str());
      if (id == 0) continue;
      std::string line = readAny(entry.path() / "cmdline");
      std::replace(line.begin(), line.end(), '\0', ' ');
      if (line.find(words) != std::string::npos) out.push_back(id);
    }
    return out;
  }

  /// Number of runs that the task's progress shows.
  size_t finished(const std::string& submission, int task) const {
    const auto json = nlohmann::json::parse(read(submission + "/task_" + std::to_string(task) + ".progress"),
                                            nullptr, false);
    return json.is_object() ? json.at("done").get<size_t>() + json.at("failed").get<size_t>() : 0;
  }

  /// Product hashes by key of everything that is done.
  static std::map<std::string, std::string> hashes(const std::string& file) {
    std::map<std::string, std::string> out;
    for (const store::Run& run : store::Store(file, store::Access::ReadOnly).allRuns())
      if (run.status == "done") {
        const bool fresh = out.emplace(run.key, run.sceneFacts.at("product_hash").get<std::string>()).second;
        EXPECT_TRUE(fresh) << run.key << " is there twice";
      }
    return out;
  }

  std::string cluster_;
};

/// `runs` runs of two scenes that take `sleepMs` each.
inline std::string tasksDescriptor(int runs, int sleepMs, const std::string& more = "") {
  std::string samples = "1";
  for (int i = 2; i <= runs / 2; ++i) samples += ", " + std::to_string(i);
  return "title: a\nquestion: b\nscenes: [{name: grid, light_size: [1, 2]}]\ntiming: {batch: 4}\n"
         "techniques:\n  - {name: soft/bitmask, samples: [" +
         samples + "], sleep_ms: " + std::to_string(sleepMs) + "}\n" + more;
}

}  // namespace limen::experiments
