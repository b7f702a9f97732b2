// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace limen {

/// Who may read a file that is made: whoever the process' umask lets, or its owner alone.
enum class Readers { Usual, OwnerOnly };

/// A file on its way: written under a hidden name beside its place and renamed once it is whole and on the
/// disk, so that the place holds all of the old content or all of the new, whatever happens meanwhile.
/// Everything that Limen writes for a user goes through here. A device or a pipe (/dev/stdout) is written to
/// as it is.
class PartFile {
 public:
  /// Throws Error: `target` is an input of this call (input_files.h), cannot be written, is a folder. What
  /// killed processes left in its folder goes.
  explicit PartFile(const std::string& target, Readers readers = Readers::Usual);
  /// Removes what was not put in place.
  ~PartFile();
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  /// Throws Error if not all of it could be written.
  void write(std::string_view bytes);
  /// Waits for the disk. Nothing can be written after it. Throws Error.
  void close();
  /// Closes and renames. Throws Error.
  void putInPlace();
  /// Where the content is until then.
  const std::string& path() const { return part_; }

 private:
  [[noreturn]] void fail(int reason) const;

  std::string named_, target_, part_;
  int file_ = -1;
  bool direct_ = false, finished_ = false;
};

/// A hidden name beside `target` that no other process and no other call gives.
std::string partNameOf(const std::string& target);
/// Whether a file's name is such a one.
bool isPartName(const std::string& name);
/// Removes files and folders with such names in `folder` whose process is dead.
void removeDeadParts(const std::string& folder);
/// The same once for each folder and process: folders with many files take time to list.
void removeDeadPartsOnce(const std::string& folder);
/// Waits until a file's content, or a folder's list of files, is on the disk. False if that failed.
bool syncPath(const std::string& path);

}  // namespace limen
