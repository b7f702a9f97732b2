// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <thread>

#include "experiments/base/error.h"
#include "experiments/base/interrupt.h"

namespace limen {
namespace {

constexpr auto kPoll = std::chrono::milliseconds(20);
constexpr int kPollsInSilence = 100;

}  // namespace

FolderLock::FolderLock(const std::string& folder) {
  const char* const path = folder.empty() ? "." : folder.c_str();
  file_ = ::open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file_ < 0)
    throw Error(std::string("the folder cannot be opened: ") + std::strerror(errno), path,
                "check the path and its rights");
  try {
    for (int polls = 0; ::flock(file_, LOCK_EX | LOCK_NB) != 0; ++polls) {
      if (errno == EINTR) continue;
      if (errno != EWOULDBLOCK) return;
      if (polls == kPollsInSilence)
        std::fprintf(stderr, "waiting for another process that writes to %s\n", path);
      throwIfInterrupted();
      std::this_thread::sleep_for(kPoll);
    }
  } catch (...) {
    ::close(file_);
    throw;
  }
}

FolderLock::~FolderLock() { ::close(file_); }

}  // namespace limen
