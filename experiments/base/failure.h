// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>

namespace limen {

/// The program's name as the user called it: "limen sweep" for "limen-sweep" that the launcher runs (which
/// says so in the environment variable LIMEN_LAUNCHER), else the name itself.
std::string calledName(const std::string& program);

/// Called in a handler: says on standard error, printable(), what the exception is about, after the program's
/// name, and returns the exit code. Interrupted says nothing.
int reportFailure(const std::string& program);

/// Called in a handler: throws Error for what work on a file ran into, naming the file, where the exception
/// does not do so itself: too little memory, lengths that cannot be. Rethrows all others.
[[noreturn]] void rethrowNaming(const std::string& file);

/// Runs `work` on a file; its exceptions name the file (rethrowNaming()).
template <class Work>
auto namingFile(const std::string& file, Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (...) {
    rethrowNaming(file);
  }
}

}  // namespace limen
