// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/shared_queue.h"

#include <fcntl.h>
#include <unistd.h>

#include <charconv>
#include <fstream>
#include <iterator>

#include "experiments/base/error.h"
#include "experiments/base/file_lock.h"

namespace limen::experiments {
namespace {

/// With one call, so that a process that is killed leaves all of it or the start of it.
void addTo(const std::string& path, const std::string& text) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  const bool whole = file >= 0 && write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  if (file >= 0) close(file);
  if (!whole) throw Error("cannot be written", path, "check permissions and free space");
}

}  // namespace

void SharedQueue::readOn() {
  std::ifstream in(path_, std::ios::binary);
  if (!in) return;  // Nobody has taken anything.
  in.seekg(static_cast<std::streamoff>(readTo_));
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  for (size_t begin = 0;;) {
    const size_t end = text.find('\n', begin);
    if (end == std::string::npos) return;
    int task = 0;
    const auto [rest, code] = std::from_chars(text.data() + begin, text.data() + end, task);
    // A line that a process which was killed has not finished names no run.
    if (code == std::errc{} && rest + 1 < text.data() + end && *rest == ' ')
      (task == task_ ? mine_ : others_).emplace(rest + 1, text.data() + end);
    readTo_ += end + 1 - begin;
    begin = end + 1;
  }
}

std::vector<bool> SharedQueue::take(const std::vector<std::string>& keys) {
  const FileLock lock(path_ + ".lock");
  readOn();
  // Ends the unfinished line of a process that was killed.
  std::string lines = "\n";
  std::vector<bool> out;
  for (const std::string& key : keys) {
    out.push_back(others_.count(key) == 0);
    if (out.back() && mine_.count(key) == 0) lines += std::to_string(task_) + " " + key + "\n";
  }
  if (lines.size() == 1) return out;
  addTo(path_, lines);
  return out;
}

}  // namespace limen::experiments
