// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace limen::viewer {

/// Encodes and writes pictures in a thread of its own, in the order in which that was asked for. Whatever was
/// asked for is complete when the writer is gone.
class PictureWriter {
 public:
  /// Writes files and returns the path to report; throws what went wrong.
  using Job = std::function<std::string()>;
  struct Report {
    std::string path;   ///< "" if it failed
    std::string error;  ///< why
  };

  /// `wake` is called from the thread after each job.
  explicit PictureWriter(std::function<void()> wake);
  /// Waits until everything is written.
  ~PictureWriter();
  PictureWriter(const PictureWriter&) = delete;
  PictureWriter& operator=(const PictureWriter&) = delete;

  void write(Job job);
  /// Of the jobs that ended since the last call, in order.
  std::vector<Report> take();
  /// Whether a job is waiting or under way.
  bool busy() const;
  /// Waits until none is.
  void finish();

 private:
  void run(const std::function<void()>& wake);

  mutable std::mutex guard_;
  std::condition_variable changed_;
  std::deque<Job> jobs_;
  std::vector<Report> reports_;
  bool working_ = false, closed_ = false;
  std::jthread thread_;  // last: it uses the others
};

}  // namespace limen::viewer
