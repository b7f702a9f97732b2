// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stop_token>
#include <utility>

namespace limen {

/// Long work asks cancelToken() between its pieces and ends early where a stop was requested; whoever set the
/// scope throws the unfinished result away. Without a scope nothing is ever cancelled.
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

/// Of the calling thread; take it before handing pieces to other threads.
inline std::stop_token cancelToken() { return CancelScope::current(); }

}  // namespace limen
