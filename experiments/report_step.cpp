// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/report_step.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <system_error>
#include <vector>

#include "experiments/base/environment.h"
#include "experiments/base/failure.h"

namespace limen::experiments {
namespace {

namespace fs = std::filesystem;

/// Exit status of the program, 127 if it cannot be started. Its standard output is discarded: it names the
/// report, which the caller does.
int call(const std::vector<std::string>& words) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int failed = posix_spawn(&child, words[0].c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  if (failed != 0 || waitpid(child, &status, 0) != child) return 127;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

ReportResult makeReport(const std::string& storeName, const std::string& folderName) {
  // "-o/store.sqlite" is a file, not an option.
  const auto asFile = [](const std::string& name) { return name.starts_with("-") ? "./" + name : name; };
  const std::string store = asFile(storeName), folder = asFile(folderName);
  std::error_code code;
  const fs::path program = fs::read_symlink("/proc/self/exe", code).parent_path() / "limen-report";
  if (code || !fs::exists(program)) return {"", "no report: limen-report is not built", false};
  const std::vector<std::string> command = {program.string(), store, "--sweeps", "-o", folder, "--force"};
  const int status = call(command);
  if (status != 0)
    return {"",
            fmt::format("the report could not be written ({} ended with {}); the runs are kept in {}; try: "
                        "limen report {}",
                        calledName("limen-report"), status, store,
                        quoteCommand({command.begin() + 1, command.end()})),
            true};
  const fs::path page = fs::path(folder) / "report.html";
  const std::string path = fs::exists(page) ? page.string() : folder;
  return {path, "report: " + path, false};
}

}  // namespace limen::experiments
