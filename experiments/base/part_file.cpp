// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/part_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <set>

#include "experiments/base/error.h"
#include "experiments/base/hash.h"
#include "experiments/base/input_files.h"
#include "experiments/base/process.h"

namespace limen {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMark = ".part-";
constexpr size_t kLongestName = 100;  // of 255 that file systems take; the mark and the process need the rest

bool isNumber(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(),
                                      [](char c) { return std::isdigit(static_cast<unsigned char>(c)); });
}

/// host:pid:start of a hidden name ".NAME.part-host:pid:start-number", or "" of any other.
std::string ownerOf(const std::string& name) {
  const size_t mark = name.rfind(kMark);
  if (name.empty() || name[0] != '.' || mark == std::string::npos || mark < 2) return {};
  const std::string rest = name.substr(mark + std::strlen(kMark));
  const size_t dash = rest.rfind('-');
  if (dash == std::string::npos || !isNumber(rest.substr(dash + 1))) return {};
  const std::string owner = rest.substr(0, dash);
  const size_t second = owner.rfind(':');
  const size_t first =
      second == std::string::npos || second == 0 ? std::string::npos : owner.rfind(':', second - 1);
  if (first == std::string::npos || !isNumber(owner.substr(first + 1, second - first - 1)) ||
      !isNumber(owner.substr(second + 1)))
    return {};
  return owner;
}

std::string folderOf(const std::string& file) {
  const std::string folder = fs::path(file).parent_path().string();
  return folder.empty() ? "." : folder;
}

// Not to be renamed over: what is written to it goes elsewhere.
bool isPassedOn(const std::string& path) {
  struct stat facts {};
  if (stat(path.c_str(), &facts) == 0) {
    if (S_ISCHR(facts.st_mode) || S_ISBLK(facts.st_mode) || S_ISFIFO(facts.st_mode) ||
        S_ISSOCK(facts.st_mode))
      return true;
  }
  for (const char* streams : {"/dev/fd/", "/dev/std", "/proc/"})
    if (path.rfind(streams, 0) == 0) return true;
  return false;
}

}  // namespace

std::string partNameOf(const std::string& target) {
  static std::atomic<unsigned> number{0};
  const fs::path path(target);
  std::string name = path.filename().string();
  if (name.size() > kLongestName) name = name.substr(0, kLongestName / 2) + sha256(name).substr(0, 16);
  return (path.parent_path() /
          ("." + name + kMark + processIdentity() + "-" + std::to_string(number.fetch_add(1))))
      .string();
}

bool isPartName(const std::string& name) { return !ownerOf(name).empty(); }

void removeDeadParts(const std::string& folder) {
  std::error_code code;
  std::set<fs::path> dead;
  for (fs::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code)) {
    const std::string owner = ownerOf(entry->path().filename().string());
    if (!owner.empty() && isOwnerDead(owner).value_or(false)) dead.insert(entry->path());
  }
  for (const fs::path& path : dead) fs::remove_all(path, code);
}

void removeDeadPartsOnce(const std::string& folder) {
  static std::mutex guard;
  static std::set<std::string> seen;
  {
    const std::scoped_lock lock(guard);
    if (!seen.insert(resolvedPath(folder)).second) return;
  }
  removeDeadParts(folder);
}

bool syncPath(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool good = ::fsync(file) == 0;
  ::close(file);
  return good;
}

PartFile::PartFile(const std::string& target, Readers readers) : named_(target) {
  direct_ = isPassedOn(target);
  if (direct_) {
    target_ = part_ = target;
    // Opened anew, a file behind standard output would be written from its beginning.
    const int stream = target == "/dev/stdout" ? STDOUT_FILENO : target == "/dev/stderr" ? STDERR_FILENO : -1;
    std::fflush(nullptr);
    file_ = stream >= 0 ? ::fcntl(stream, F_DUPFD_CLOEXEC, 0) : ::open(target.c_str(), O_WRONLY | O_CLOEXEC);
    if (file_ < 0) fail(errno);
    return;
  }
  requireNoInput(target);
  // A link stays one: what it points to is replaced.
  std::error_code code;
  target_ = fs::is_symlink(target, code) ? resolvedPath(target) : target;
  struct stat old {};
  const bool exists = stat(target_.c_str(), &old) == 0;
  if (exists && S_ISDIR(old.st_mode)) fail(EISDIR);
  // Renaming needs no right on the file itself, but whoever took that away meant it.
  if (exists && access(target_.c_str(), W_OK) != 0) fail(errno);
  removeDeadPartsOnce(folderOf(target_));
  part_ = partNameOf(target_);
  const bool hidden = readers == Readers::OwnerOnly;
  file_ = ::open(part_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, hidden ? 0600 : 0666);
  if (file_ < 0) fail(errno);
  if (exists && !hidden) ::fchmod(file_, old.st_mode & 07777);
}

PartFile::~PartFile() {
  if (file_ >= 0) ::close(file_);
  if (!direct_ && !finished_ && !part_.empty()) ::unlink(part_.c_str());
}

void PartFile::fail(int reason) const {
  throw Error(std::string("cannot be written: ") + std::strerror(reason), named_,
              "check the folder, its permissions and the space left");
}

void PartFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(file_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) fail(count < 0 ? errno : ENOSPC);
    bytes.remove_prefix(static_cast<size_t>(count));
  }
}

void PartFile::close() {
  if (file_ < 0) return;
  // Renamed before its content is on the disk, the file could be empty after a loss of power. Pipes cannot.
  if (::fsync(file_) != 0 && !direct_) fail(errno);
  const int closed = ::close(file_);
  file_ = -1;
  if (closed != 0) fail(errno);
}

void PartFile::putInPlace() {
  close();
  if (!direct_) {
    if (std::rename(part_.c_str(), target_.c_str()) != 0) fail(errno);
    syncPath(folderOf(target_));
  }
  finished_ = true;
}

}  // namespace limen
