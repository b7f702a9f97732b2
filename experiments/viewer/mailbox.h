// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <utility>

namespace limen::viewer {

/// Hands the newest of something to another thread: an item not yet taken when the next one arrives is
/// dropped. Neither side ever waits for the other's work.
template <class Thing>
class Mailbox {
 public:
  void put(Thing thing) {
    {
      const std::scoped_lock lock(guard_);
      thing_ = std::move(thing);
    }
    changed_.notify_all();
  }
  /// Puts back what was taken, unless something newer has arrived.
  void putBack(Thing thing) {
    const std::scoped_lock lock(guard_);
    if (!thing_) thing_ = std::move(thing);
  }
  std::optional<Thing> take() {
    const std::scoped_lock lock(guard_);
    return std::exchange(thing_, std::nullopt);
  }
  bool waiting() const {
    const std::scoped_lock lock(guard_);
    return thing_.has_value();
  }
  /// True as soon as there is something to take or close() was called; false after `time`.
  template <class Duration>
  bool wait(Duration time) const {
    std::unique_lock lock(guard_);
    return changed_.wait_for(lock, time, [&] { return thing_.has_value() || closed_; });
  }
  void close() {
    {
      const std::scoped_lock lock(guard_);
      closed_ = true;
    }
    changed_.notify_all();
  }
  bool closed() const {
    const std::scoped_lock lock(guard_);
    return closed_;
  }

 private:
  mutable std::mutex guard_;
  mutable std::condition_variable changed_;
  std::optional<Thing> thing_;
  bool closed_ = false;
};

}  // namespace limen::viewer
