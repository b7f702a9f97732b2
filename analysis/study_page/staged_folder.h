// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace limen::analysis {

/// A folder that is filled beside the one it is for, so that an error on the way leaves that as it was.
class StagedFolder {
 public:
  /// Throws Error if nothing can be written there.
  explicit StagedFolder(const std::string& target);
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  const std::filesystem::path& path() const { return staging_; }
  /// Moves every file into the target, over those of the same name; others there stay. Throws Error.
  void putInPlace() const;

 private:
  std::filesystem::path target_, staging_;
};

}  // namespace limen::analysis
