// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/submission.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <system_error>

#include "experiments/base/clock.h"
#include "experiments/base/error.h"
#include "experiments/base/hash.h"
#include "experiments/base/process.h"
#include "experiments/base/replace_file.h"

namespace limen::experiments {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFile = "submission.json";

std::string textOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error("cannot be read", path, "see that the folder is whole and its rights");
  return {std::istreambuf_iterator<char>(in), {}};
}

/// 0 if it is no number.
int numberOf(const std::string& name) {
  int number = 0;
  const auto [end, code] = std::from_chars(name.data(), name.data() + name.size(), number);
  return code == std::errc{} && end == name.data() + name.size() && number > 0 ? number : 0;
}

std::vector<int> numbersIn(const std::string& folder) {
  std::vector<int> out;
  std::error_code code;
  for (fs::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code))
    if (const int number = numberOf(entry->path().filename().string())) out.push_back(number);
  std::sort(out.begin(), out.end());
  return out;
}

/// Unique, and plain enough for every list of Slurm's.
std::string jobName(const Submission& submission) {
  std::string stem;
  for (const char c : fs::path(submission.store).stem().string())
    stem += (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ? c : '_';
  const std::string unique = sha256(processIdentity() + utcNow() + submission.folder).substr(0, 8);
  return "limen_" + stem.substr(0, 40) + "_" + unique;
}

std::string file(const Submission& submission, int task, const char* extension) {
  return submission.folder + "/task_" + std::to_string(task) + extension;
}

}  // namespace

std::string tasksFolder(const std::string& store) {
  const fs::path path = fs::absolute(store).lexically_normal();
  return (path.parent_path() / (path.stem().string() + "_tasks")).string();
}

Submission readSubmission(const std::string& folder) {
  const std::string path = folder + "/" + kFile;
  Submission out;
  try {
    const nlohmann::json json = nlohmann::json::parse(textOf(path));
    out.folder = folder;
    json.at("name").get_to(out.name);
    json.at("started_in").get_to(out.startedIn);
    json.at("descriptors").get_to(out.descriptors);
    json.at("experiments").get_to(out.experiments);
    json.at("store").get_to(out.store);
    json.at("root").get_to(out.root);
    json.at("references").get_to(out.references);
    json.at("device").get_to(out.device);
    json.at("array").get_to(out.array);
    json.at("owner").get_to(out.owner);
    json.at("slurm_options").get_to(out.slurmOptions);
    json.at("tasks").get_to(out.tasks);
    json.at("attempt").get_to(out.attempt);
    json.at("report").get_to(out.report);
  } catch (const nlohmann::json::exception&) {
    throw Error("is not what limen submit writes", path, "put it back, or move its folder away");
  }
  return out;
}

std::vector<Submission> readSubmissions(const std::string& store) {
  std::vector<Submission> out;
  const std::string folder = tasksFolder(store);
  for (const int number : numbersIn(folder)) {
    const std::string one = folder + "/" + std::to_string(number);
    // One without the file was never submitted: its process ended before.
    if (fs::exists(one + "/" + kFile)) out.push_back(readSubmission(one));
  }
  return out;
}

void requireUtf8(const nlohmann::json& names) {
  try {
    static_cast<void>(names.dump());
  } catch (const nlohmann::json::exception&) {
    throw Error("the name of a file, a folder or an option is not UTF-8", "command line",
                "rename it: it could not be handed to the tasks as it is");
  }
}

void writeSubmission(Submission& submission, const std::vector<std::vector<std::string>>& keys) {
  const std::string all = tasksFolder(resolvePath(submission.startedIn, submission.store));
  const std::vector<int> numbers = numbersIn(all);
  submission.folder = all + "/" + std::to_string(numbers.empty() ? 1 : numbers.back() + 1);
  submission.tasks = static_cast<int>(keys.size());
  submission.name = jobName(submission);
  const nlohmann::json description = {{"name", submission.name},
                                      {"started_in", submission.startedIn},
                                      {"descriptors", submission.descriptors},
                                      {"experiments", submission.experiments},
                                      {"store", submission.store},
                                      {"root", submission.root},
                                      {"references", submission.references},
                                      {"device", submission.device},
                                      {"array", submission.array},
                                      {"owner", submission.owner},
                                      {"slurm_options", submission.slurmOptions},
                                      {"tasks", submission.tasks},
                                      {"attempt", submission.attempt},
                                      {"report", submission.report}};
  requireUtf8(description);
  std::error_code code;
  fs::create_directories(submission.folder, code);
  if (code)
    throw Error("cannot create the folder: " + code.message(), submission.folder,
                "check permissions and free space");
  for (size_t i = 0; i < keys.size(); ++i) {
    std::string lines;
    for (const std::string& key : keys[i]) lines += key + "\n";
    replaceFile(file(submission, static_cast<int>(i) + 1, ".keys"), lines);
  }
  replaceFile(submission.folder + "/" + kFile, description.dump(1) + "\n");
}

std::string taskStore(const Submission& submission, int task) { return file(submission, task, ".sqlite"); }
std::string taskLog(const Submission& submission, int task) { return file(submission, task, ".log"); }

std::string queueFile(const Submission& submission) { return submission.folder + "/taken"; }

std::vector<std::string> taskKeys(const Submission& submission, int task) {
  std::vector<std::string> out;
  const std::string text = textOf(file(submission, task, ".keys"));
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    out.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return out;
}

std::string resolvePath(const std::string& folder, const std::string& path) {
  return (fs::path(folder) / path).lexically_normal().string();
}

}  // namespace limen::experiments
