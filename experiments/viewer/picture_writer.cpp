// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/picture_writer.h"

#include <exception>
#include <utility>

namespace limen::viewer {

PictureWriter::PictureWriter(std::function<void()> wake)
    : thread_([this, wake = std::move(wake)] { run(wake); }) {}

PictureWriter::~PictureWriter() {
  {
    const std::scoped_lock lock(guard_);
    closed_ = true;
  }
  changed_.notify_all();
}

void PictureWriter::write(Job job) {
  {
    const std::scoped_lock lock(guard_);
    jobs_.push_back(std::move(job));
  }
  changed_.notify_all();
}

std::vector<PictureWriter::Report> PictureWriter::take() {
  const std::scoped_lock lock(guard_);
  return std::exchange(reports_, {});
}

bool PictureWriter::busy() const {
  const std::scoped_lock lock(guard_);
  return working_ || !jobs_.empty();
}

void PictureWriter::finish() {
  std::unique_lock lock(guard_);
  changed_.wait(lock, [&] { return !working_ && jobs_.empty(); });
}

void PictureWriter::run(const std::function<void()>& wake) {
  std::unique_lock lock(guard_);
  while (true) {
    changed_.wait(lock, [&] { return closed_ || !jobs_.empty(); });
    if (jobs_.empty()) return;
    Job job = std::move(jobs_.front());
    jobs_.pop_front();
    working_ = true;
    lock.unlock();
    Report report;
    try {
      report.path = job();
    } catch (const std::exception& error) {
      report.error = error.what();
    }
    job = nullptr;  // its images are freed before anyone is told
    lock.lock();
    reports_.push_back(std::move(report));
    working_ = false;
    lock.unlock();
    changed_.notify_all();
    wake();
    lock.lock();
  }
}

}  // namespace limen::viewer
