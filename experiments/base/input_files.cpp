// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/input_files.h"

#include <sys/stat.h>

#include <filesystem>
#include <mutex>
#include <set>

#include "experiments/base/error.h"

namespace limen {
namespace {

namespace fs = std::filesystem;

constexpr int kMostLinks = 40;  // as the kernel

std::mutex guard;
std::set<std::string>& inputs() {
  static std::set<std::string> all;  // resolved
  return all;
}

bool isSameFile(const struct stat& a, const std::string& path) {
  struct stat b {};
  return stat(path.c_str(), &b) == 0 && a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

}  // namespace

std::string resolvedPath(const std::string& path) {
  std::error_code code;
  fs::path file = fs::absolute(path, code);
  // weakly_canonical() leaves a link as it is that leads to a file which does not exist yet.
  for (int i = 0; i < kMostLinks && fs::is_symlink(file, code); ++i) {
    const fs::path to = fs::read_symlink(file, code);
    if (code) break;
    file = to.is_absolute() ? to : file.parent_path() / to;
  }
  const fs::path whole = fs::weakly_canonical(file, code);
  return code ? file.lexically_normal().string() : whole.string();
}

void protectInput(const std::string& path) {
  if (path.empty()) return;
  const std::string name = resolvedPath(path);
  const std::scoped_lock lock(guard);
  inputs().insert(name);
}

void requireNoInput(const std::string& path, const std::string& where) {
  struct stat facts {};
  const bool exists = stat(path.c_str(), &facts) == 0;
  if (exists && !S_ISREG(facts.st_mode)) return;  // a device or a pipe keeps nothing
  const std::string name = resolvedPath(path);
  const std::scoped_lock lock(guard);
  for (const std::string& input : inputs())
    if (name == input || (exists && isSameFile(facts, input)))
      throw Error(where.empty() ? "is an input" : "'" + path + "' is an input", where.empty() ? path : where,
                  "inputs are never overwritten: give another name");
}

}  // namespace limen
