// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "experiments/base/part_file.h"

namespace limen {

/// A folder that is filled under a hidden name, beside the one it is for or in it if that exists, so that an
/// error on the way leaves that as it was, and two processes that fill the same one do not get into each
/// other's way.
class StagedFolder {
 public:
  /// Throws Error if nothing can be written there. What killed processes left there goes.
  explicit StagedFolder(const std::string& target, Readers readers = Readers::Usual);
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  const std::filesystem::path& path() const { return staging_; }
  /// Moves every file into the target, over those of the same name; others there stay. Of two processes one
  /// moves all of its files after the other. Throws Error, before anything is moved if a file is an input of
  /// this call.
  void putInPlace() const;
  /// Makes this the target, which must not exist or be empty. Throws Error.
  void putInPlaceAsNew() const;

 private:
  void sync() const;

  void moveFiles() const;

  std::filesystem::path target_, staging_;
  bool inside_ = false;
};

}  // namespace limen
