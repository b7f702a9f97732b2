// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <unordered_set>
#include <vector>

#include "experiments/base/yaml_tree.h"

namespace limen {

/// Collects the problems of one file, so that a user sees all of them at once.
class Problems {
 public:
  explicit Problems(std::string file) : file_(std::move(file)) {}

  /// Repeats of a problem at the same place are dropped.
  void add(Mark mark, const std::string& what, const std::string& hint = {});
  /// So many that hints to more of them help nobody, and finding them would take long.
  bool crowded() const { return lines_.size() >= 1000; }
  bool empty() const { return lines_.empty(); }
  size_t size() const { return lines_.size(); }
  const std::string& file() const { return file_; }

  /// Throws one Error with a line for each problem (the first twenty), in file order; returns if there are
  /// none.
  void throwIfAny() const;

 private:
  struct Line {
    Mark mark;
    std::string text;
  };
  std::string file_;
  std::vector<Line> lines_;
  std::unordered_set<std::string> said_;
};

}  // namespace limen
