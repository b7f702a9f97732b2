// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace limen::experiments {

/// A sweep shared out among tasks, as a folder beside the store: STORE_tasks/3/ has submission.json, for each
/// task its runs (task_1.keys), its store (task_1.sqlite) and what it printed (task_1.log).
struct Submission {
  std::string folder;                    ///< absolute
  std::string name;                      ///< of its jobs: letters, digits, dots and underscores
  std::string startedIn;                 ///< folder that relative names are relative to
  std::vector<std::string> descriptors;  ///< as given, or absolute
  std::vector<std::string> experiments;  ///< hashes of their texts
  std::string store, root, references, device;
  std::string array;  ///< as given: "64", "64%8"; "": the tasks run on this host
  std::string owner;  ///< claimOwner() of the process that keeps them running then
  std::vector<std::string> slurmOptions;
  int tasks = 0;
  int attempt = 1;  ///< of so many that runs which tasks left behind are submitted again
  bool report = true;
};

/// Folder of a store's submissions.
std::string tasksFolder(const std::string& store);
/// All submissions of a store, oldest first. Throws Error for one that cannot be read.
std::vector<Submission> readSubmissions(const std::string& store);
Submission readSubmission(const std::string& folder);

/// Throws Error if text in it cannot be written to submission.json.
void requireUtf8(const nlohmann::json& names);

/// Makes the folder after the last one and writes the keys of each task. Sets folder, tasks and name.
void writeSubmission(Submission& submission, const std::vector<std::vector<std::string>>& keys);

std::string taskStore(const Submission& submission, int task);
std::string taskLog(const Submission& submission, int task);
/// Of the runs that tasks on one host have taken (SharedQueue).
std::string queueFile(const Submission& submission);
std::vector<std::string> taskKeys(const Submission& submission, int task);

/// `path`, relative to `folder` unless absolute.
std::string resolvePath(const std::string& folder, const std::string& path);

}  // namespace limen::experiments
