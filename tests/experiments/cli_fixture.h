// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace limen::experiments {

struct CallResult {
  int exitCode = 0;
  std::string out, err;
};

/// Calls sweep_fake inside a fresh folder that goes with the test.
class SweepCli : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "limen_sweep_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  std::string read(const std::string& name) const {
    std::ifstream stream(folder_ / name, std::ios::binary);
    std::stringstream text;
    text << stream.rdbuf();
    return text.str();
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// Starts the program; its outputs go to files NAME.out and NAME.err.
  pid_t start(const std::vector<std::string>& arguments, const std::string& name = "call") const {
    // Made before: another thread may hold the allocator's lock while the process is copied.
    std::vector<std::string> words = {program_};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> raw;
    for (std::string& word : words) raw.push_back(word.data());
    raw.push_back(nullptr);
    const std::string out = path(name + ".out"), err = path(name + ".err");
    const pid_t child = fork();
    if (child != 0) return child;
    dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
    dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
    if (chdir(folder_.c_str()) != 0) _exit(126);
    execv(raw[0], raw.data());
    _exit(127);
  }

  CallResult wait(pid_t child, const std::string& name = "call") const {
    int status = 0;
    waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), read(name + ".out"),
            read(name + ".err")};
  }

  CallResult call(const std::vector<std::string>& arguments) const { return wait(start(arguments)); }

  static std::vector<nlohmann::json> jsonLines(const std::string& text) {
    std::vector<nlohmann::json> out;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) out.push_back(nlohmann::json::parse(line));
    return out;
  }

  std::filesystem::path folder_;
  std::string program_ = std::string(LIMEN_BIN_DIR) + "/sweep_fake";
};

}  // namespace limen::experiments
