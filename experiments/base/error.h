// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace limen {

/// An error that a user can cause and fix. `what` names the thing, `where` the file and line (or the
/// command-line option), `hint` what to do about it. Programmer errors are assertions instead.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& what, const std::string& where = {}, const std::string& hint = {})
      : std::runtime_error((where.empty() ? what : where + ": " + what) + (hint.empty() ? "" : "; " + hint)),
        message_(what),
        where_(where),
        hint_(hint) {}

  const std::string& message() const { return message_; }
  const std::string& where() const { return where_; }
  const std::string& hint() const { return hint_; }

 private:
  std::string message_, where_, hint_;
};

/// Exit codes of every program.
inline constexpr int kExitSuccess = 0;
inline constexpr int kExitFailedRuns = 1;  ///< runs failed or an expectation was not met
inline constexpr int kExitBadInput = 2;    ///< the input was refused; nothing ran

}  // namespace limen
