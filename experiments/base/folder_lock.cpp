// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <thread>

#include "experiments/base/error.h"
#include "experiments/base/file_lock.h"
#include "experiments/base/interrupt.h"

namespace limen {
namespace {

// Most locks are held for a moment, some for minutes.
constexpr std::chrono::milliseconds kShortestPoll{1}, kLongestPoll{20};
constexpr int kPollsInSilence = 100;

/// Closes the file if it throws.
void waitForLock(int file, const char* path) {
  try {
    std::chrono::milliseconds poll = kShortestPoll;
    for (int polls = 0; ::flock(file, LOCK_EX | LOCK_NB) != 0; ++polls) {
      if (errno == EINTR) continue;
      if (errno != EWOULDBLOCK) return;
      if (polls == kPollsInSilence)
        std::fprintf(stderr, "waiting for another process that writes to %s\n", path);
      throwIfInterrupted();
      std::this_thread::sleep_for(poll);
      poll = std::min(2 * poll, kLongestPoll);
    }
  } catch (...) {
    ::close(file);
    throw;
  }
}

}  // namespace

FolderLock::FolderLock(const std::string& folder) {
  const char* const path = folder.empty() ? "." : folder.c_str();
  file_ = ::open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file_ < 0)
    throw Error(std::string("the folder cannot be opened: ") + std::strerror(errno), path,
                "check the path and its rights");
  waitForLock(file_, path);
}

FolderLock::~FolderLock() { ::close(file_); }

// Locks of network file systems are for files that are open for writing, which a folder cannot be.
FileLock::FileLock(const std::string& path) : path_(path) {
  file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0)
    throw Error(std::string("the lock cannot be made: ") + std::strerror(errno), path,
                "check the folder's rights and free space");
  waitForLock(file_, path.c_str());
}

FileLock::~FileLock() { ::close(file_); }

void FileLock::removeFile() { ::unlink(path_.c_str()); }

}  // namespace limen
