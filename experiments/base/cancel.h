// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stop_token>
#include <utility>

namespace limen {

/// Long-running work checks cancelToken() between steps and returns early once a stop was requested; whoever
/// set the scope discards the unfinished result. Without a scope nothing is ever cancelled.
class CancelScope {
 public:
  explicit CancelScope(std::stop_token token) : before_(std::exchange(current(), std::move(token))) {}
  ~CancelScope() { current() = std::move(before_); }
  CancelScope(const CancelScope&) = delete;
  CancelScope& operator=(const CancelScope&) = delete;

  /// Of this thread.
  static std::stop_token& current() {
    thread_local std::stop_token token;
    return token;
  }

 private:
  std::stop_token before_;
};

/// Of the calling thread; get it before handing work to other threads.
inline std::stop_token cancelToken() { return CancelScope::current(); }

}  // namespace limen
