// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace limen::experiments {

/// Runs that tasks of one submission take from each other, so that they end together however long runs take:
/// a file that all of them add lines to, TASK KEY. A task that was started again still has what it took.
class SharedQueue {
 public:
  /// `path`: the file, which need not exist; another is made beside it as its lock.
  SharedQueue(std::string path, int task) : path_(std::move(path)), task_(task) {}

  /// Takes for this task what no other has taken. Returns for each key whether it is this task's now. Throws
  /// Error if the file cannot be read or written.
  std::vector<bool> take(const std::vector<std::string>& keys);

 private:
  void readOn();

  std::string path_;
  int task_;
  size_t readTo_ = 0;  ///< bytes of the file
  std::set<std::string> mine_, others_;
};

}  // namespace limen::experiments
