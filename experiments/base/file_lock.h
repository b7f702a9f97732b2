// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace limen {

/// Holds a file, which is made for that purpose, against other processes, also those of other hosts that
/// share the file system, and waits for them; says so on standard error if it takes long. Released with the
/// object, or with the process however that ends. On file systems without locks it does nothing.
class FileLock {
 public:
  /// The file's folder exists. Throws Error if it cannot be made, Interrupted after a signal.
  explicit FileLock(const std::string& path);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

  /// Removes the file, still held. Whoever waits for it gets it then, and another may make a new one: only
  /// for work after which nobody needs the lock any more.
  void removeFile();

 private:
  std::string path_;
  int file_ = -1;
};

}  // namespace limen
