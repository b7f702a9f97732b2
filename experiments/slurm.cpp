// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/slurm.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include "experiments/base/child_process.h"
#include "experiments/base/environment.h"
#include "experiments/base/error.h"
#include "experiments/base/replace_file.h"

namespace limen::experiments {
namespace {

constexpr const char* kMergeSuffix = ".merge";

/// Options of sbatch that submit gives, by their long and short names.
struct OwnOption {
  const char* name;
  char letter;
  const char* instead;
};
constexpr std::array kOwnOptions = {
    OwnOption{"array", 'a', "say --array N[%AT_ONCE] before the --"},
    OwnOption{"dependency", 'd', "submit when the other job has ended"},
    OwnOption{"job-name", 'J', "jobs get names by which limen status finds them"},
    OwnOption{"output", 'o', "logs lie beside the stores of the tasks"},
    OwnOption{"error", 'e', "logs lie beside the stores of the tasks"},
    OwnOption{"open-mode", 0, "logs are appended to"},
    OwnOption{"chdir", 'D', "tasks work in the folder of the submission"},
    OwnOption{"no-requeue", 0, "a requeued task goes on where it was"},
    OwnOption{"parsable", 0, "submit reads what sbatch prints"},
    OwnOption{"wait", 'W', "use limen status"},
    OwnOption{"test-only", 0, "use limen submit --dry-run"},
    OwnOption{"wrap", 0, "submit runs nothing but tasks of the sweep"},
};

/// The environment of a job is not for the jobs that it submits, but for where Slurm's configuration is.
bool isOfThisJob(const std::string& variable) {
  return variable.starts_with("SLURM") && variable != "SLURM_CONF" && variable != "SLURM_TIME_FORMAT";
}

/// Slurm replaces %j and others in names of logs, in that of their folder too.
std::string escapePercent(const std::string& folder) {
  std::string out;
  for (const char c : folder) out += c == '%' ? "%%" : std::string(1, c);
  return out;
}

SlurmJob makeJob(const Submission& submission, const std::string& name, const std::string& log,
                 const std::string& verb, const std::string& comment, std::vector<std::string> more) {
  SlurmJob job;
  job.scriptPath = submission.folder + "/" + verb + ".sh";
  job.script = "#!/bin/sh\n# " + comment + "\n# Its arguments are the program to run, \"job\", \"" + verb +
               "\" and this script's folder.\nexec \"$@\"\n";
  job.call = {"sbatch"};
  // Ours come last: the last of an option holds.
  for (const std::string& option : submission.slurmOptions) job.call.push_back(option);
  const std::string path = "=" + escapePercent(submission.folder) + "/" + log;
  for (const std::string& option : {std::string("--parsable"), "--job-name=" + name, std::string("--requeue"),
                                    std::string("--open-mode=append"), "--chdir=" + submission.folder,
                                    "--output" + path, "--error" + path})
    job.call.push_back(option);
  job.call.insert(job.call.end(), more.begin(), more.end());
  for (const std::string& word : {job.scriptPath, ownProgram(), std::string("job"), verb, submission.folder})
    job.call.push_back(word);
  return job;
}

}  // namespace

bool isActive(const SlurmTask& task) {
  for (const char* over : {"BOOT_FAIL", "CANCELLED", "COMPLETED", "DEADLINE", "FAILED", "NODE_FAIL",
                           "OUT_OF_MEMORY", "REVOKED", "TIMEOUT"})
    if (task.state.starts_with(over)) return false;
  return true;
}

void checkSlurmOptions(const std::vector<std::string>& options) {
  for (const std::string& option : options) {
    // A word that is no option would be the script, and an option without its value take our next one.
    const bool alone = option.size() == 2 && option[0] == '-' && !std::strchr("HIOQhkvs", option[1]);
    if (!option.starts_with("-") || option == "-" || option == "--" || alone)
      throw Error(fmt::format("'{}' is no option with its value in one word", option), "options of sbatch",
                  "write --partition=gpu or -pgpu");
    for (const OwnOption& own : kOwnOptions) {
      const std::string name = "--" + std::string(own.name);
      const bool isLong = option == name || option.starts_with(name + "=");
      const bool isShort =
          own.letter != 0 && option.size() > 1 && option[0] == '-' && option[1] == own.letter;
      if (isLong || isShort)
        throw Error(fmt::format("'{}' is set by limen submit", option), "options of sbatch", own.instead);
    }
  }
}

std::pair<int, int> readArray(const std::string& text) {
  std::pair<int, int> out{0, 0};
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, out.first);
  bool good = first.ec == std::errc{} && out.first > 0;
  if (good && first.ptr != end) {
    good = *first.ptr == '%';
    const auto second = std::from_chars(first.ptr + 1, end, out.second);
    good = good && second.ec == std::errc{} && second.ptr == end && out.second > 0;
  }
  if (!good)
    throw Error("'" + text + "' is not a number of tasks", "--array",
                "give N, or N%M for M at once: --array 64%8");
  return out;
}

void requireSlurmName(const std::string& folder) {
  if (folder.find('\\') != std::string::npos)
    throw Error("the folder's name holds a backslash, which Slurm takes for an instruction", folder,
                "rename it, or name a store elsewhere");
}

SlurmJob arrayJob(const Submission& submission) {
  const int atOnce = readArray(submission.array).second;
  std::string array = fmt::format("--array=1-{}", submission.tasks);
  if (atOnce > 0) array += fmt::format("%{}", atOnce);
  return makeJob(submission, submission.name, "task_%a.log", "task",
                 "A task of a job array: measures its share of the sweep into a store of its own.", {array});
}

SlurmJob mergeJob(const Submission& submission, const std::string& array) {
  return makeJob(submission, submission.name + kMergeSuffix, "merge.log", "merge",
                 "Merges the stores of the tasks, submits what they left behind, writes the report.",
                 {"--dependency=afterany:" + array});
}

void writeScript(const SlurmJob& job) { replaceFile(job.scriptPath, job.script); }

void requireSlurm() {
  if (findProgram("sbatch").empty())
    throw Error("Slurm is not here: no program 'sbatch'", "PATH",
                "submit on a machine of a cluster; on Debian the package slurm-client has it "
                "(slurm-wlm a whole Slurm)");
}

std::string submitJob(const SlurmJob& job) {
  const ProgramOutput answer = runAndRead(job.call, isOfThisJob);
  std::string number = answer.out.substr(0, answer.out.find_first_of(";\n"));
  if (answer.status != 0 || number.empty() || number.find_first_not_of("0123456789") != std::string::npos) {
    std::string said = answer.err + answer.out;
    while (said.ends_with("\n")) said.pop_back();
    throw Error(fmt::format("sbatch ended with {}: {}", answer.status, said), job.scriptPath,
                "mend its options; by hand: " + quoteCommand(job.call));
  }
  return number;
}

std::optional<std::vector<SlurmTask>> listJobs(const Submission& submission) {
  if (submission.array.empty()) return std::vector<SlurmTask>();
  const ProgramOutput answer = runAndRead({"squeue", "--noheader", "--array", "--states=all",
                                           "--name=" + submission.name + "," + submission.name + kMergeSuffix,
                                           "--format=%j|%A|%K|%T|%N|%F|%r"});
  if (answer.status != 0) return std::nullopt;
  std::vector<SlurmTask> out;
  std::istringstream lines(answer.out);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> fields;
    std::istringstream rest(line);
    for (std::string field; std::getline(rest, field, '|');) fields.push_back(field);
    fields.resize(7);
    SlurmTask task;
    task.job = fields[1];
    task.index = std::atoi(fields[2].c_str());
    task.merge = fields[0].ends_with(kMergeSuffix);
    task.state = fields[3];
    task.nodes = fields[4];
    task.array = fields[5];
    task.reason = fields[6];
    out.push_back(std::move(task));
  }
  return out;
}

}  // namespace limen::experiments
