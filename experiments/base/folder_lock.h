// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace limen {

/// Holds a folder against other processes of Limen that want to change what lies in it, and waits for them;
/// says so on standard error if it takes long. Released with the object, or with the process however that
/// ends. On file systems without locks it does nothing.
class FolderLock {
 public:
  /// The folder exists. Throws Error if it cannot be opened, Interrupted after a signal.
  explicit FolderLock(const std::string& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_ = -1;
};

}  // namespace limen
