// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/failure.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string_view>

#include "experiments/base/error.h"
#include "experiments/base/interrupt.h"
#include "experiments/base/printable.h"

namespace limen {

std::string calledName(const std::string& program) {
  constexpr std::string_view kPrefix = "limen-";
  const char* launcher = std::getenv("LIMEN_LAUNCHER");
  if (launcher == nullptr || *launcher == '\0' || !program.starts_with(kPrefix)) return program;
  return "limen " + program.substr(kPrefix.size());
}

int reportFailure(const std::string& program) {
  std::string text;
  int code = kExitFailedRuns;
  try {
    throw;
  } catch (const Interrupted&) {
    return exitCodeAfter(kExitFailedRuns);
  } catch (const Error& error) {
    // Not what(), which ends at the first NUL.
    text = (error.where().empty() ? "" : error.where() + ": ") + error.message() +
           (error.hint().empty() ? "" : "; " + error.hint());
    code = kExitBadInput;
  } catch (const std::filesystem::filesystem_error& error) {
    text = (error.path1().empty() ? "" : "'" + error.path1().string() + "': ") + error.code().message();
    code = kExitBadInput;
  } catch (const std::bad_alloc&) {
    text = "there is not enough memory for this";
  } catch (const std::exception& error) {
    text = error.what();
  } catch (...) {
    text = "an unknown failure";
  }
  std::fprintf(stderr, "%s: %s\n", program.c_str(), printable(text).c_str());
  return exitCodeAfter(code);
}

void rethrowNaming(const std::string& file) {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    throw Error("takes more memory than there is", file, "give a smaller file");
  } catch (const std::length_error&) {
    throw Error("takes more memory than there is", file, "give a smaller file");
  }
}

}  // namespace limen
