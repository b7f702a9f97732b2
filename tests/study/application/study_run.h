// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace limen::test {

/// limen-study run, started on a display and led by synthetic keys: what it announces on its standard output
/// is waited for, never a time.
class StudyRun {
 public:
  /// `arguments` after "run". Its messages go to a file.
  StudyRun(const std::string& display, const std::vector<std::string>& arguments, std::string messageFile);
  ~StudyRun();
  StudyRun(const StudyRun&) = delete;
  StudyRun& operator=(const StudyRun&) = delete;

  /// The next line of its output; "" at the end of it. Throws std::runtime_error after two minutes of
  /// silence.
  std::string line();
  /// Skips lines until "screen: NAME". False: the output ended before.
  bool reaches(const std::string& screen);
  /// Arguments for xdotool, such as {"key", "y"}.
  void act(const std::vector<std::string>& words) const;
  void key(const std::string& name) const { act({"key", name}); }
  void signal(int number) const;
  /// Reads the rest and gives the exit status, or minus the signal that ended it.
  int finish();
  const std::string& rest() const { return rest_; }
  std::string messages() const;

 private:
  std::string display_, messageFile_, rest_, buffer_;
  pid_t process_ = -1;
  int output_ = -1;
};

}  // namespace limen::test
