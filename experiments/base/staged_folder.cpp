// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/staged_folder.h"

#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>
#include <vector>

#include "experiments/base/error.h"
#include "experiments/base/folder_lock.h"
#include "experiments/base/input_files.h"

namespace limen {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& folder, const std::string& reason) {
  throw Error("the folder cannot be made: " + reason, folder.string(), "choose another with -o");
}

[[noreturn]] void failToWrite(const fs::path& file, const std::string& reason) {
  throw Error("cannot be written: " + reason, file.string(),
              "check the rights on its folder and the space on the disk");
}

[[noreturn]] void refuseFull(const fs::path& folder) {
  throw Error("is not an empty folder", folder.string(), "name a new one; nothing there is overwritten");
}

}  // namespace

StagedFolder::StagedFolder(const std::string& target, Readers readers)
    : target_(fs::absolute(target).lexically_normal()) {
  if (!target_.has_filename()) target_ = target_.parent_path();
  std::error_code error;
  if (fs::is_symlink(target_, error)) target_ = resolvedPath(target_.string());
  // In the same file system, so that moving is renaming; the folder above an existing one may not be ours.
  inside_ = fs::exists(target_, error);
  if (inside_ && !fs::is_directory(target_, error)) refuse(target_, std::strerror(ENOTDIR));
  const fs::path parent = inside_ ? target_ : target_.parent_path();
  fs::create_directories(parent, error);
  if (error) refuse(target_, error.message());
  removeDeadPartsOnce(parent.string());
  staging_ = partNameOf((parent / (target_.has_filename() ? target_.filename() : "folder")).string());
  if (::mkdir(staging_.c_str(), readers == Readers::OwnerOnly ? 0700 : 0777) != 0)
    refuse(target_, std::strerror(errno));
}

StagedFolder::~StagedFolder() {
  std::error_code error;
  fs::remove_all(staging_, error);
}

void StagedFolder::sync() const {
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(staging_))
    if (!syncPath(entry.path().string())) failToWrite(entry.path(), std::strerror(errno));
}

void StagedFolder::putInPlace() const {
  sync();
  std::error_code error;
  fs::create_directories(target_, error);
  if (error) refuse(target_, error.message());
  const FolderLock lock(target_.string());
  moveFiles();
}

void StagedFolder::moveFiles() const {
  std::error_code error;
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(staging_)) {
    const fs::path to = target_ / fs::relative(entry.path(), staging_);
    if (entry.is_directory()) {
      fs::create_directories(to, error);
      if (error) refuse(to, error.message());
    } else {
      requireNoInput(to.string());
      if (fs::is_directory(to, error)) failToWrite(to, std::strerror(EISDIR));
      files.push_back(entry.path());
    }
  }
  for (const fs::path& file : files) {
    const fs::path to = target_ / fs::relative(file, staging_);
    fs::rename(file, to, error);
    if (error) failToWrite(to, error.message());
  }
  syncPath(target_.string());
}

void StagedFolder::putInPlaceAsNew() const {
  sync();
  if (inside_) {
    const FolderLock lock(target_.string());
    for (const fs::directory_entry& entry : fs::directory_iterator(target_))
      if (!isPartName(entry.path().filename().string())) refuseFull(target_);
    return moveFiles();
  }
  if (std::rename(staging_.c_str(), target_.c_str()) == 0) {
    syncPath(target_.parent_path().string());
    return;
  }
  const int reason = errno;
  if (reason == ENOTEMPTY || reason == EEXIST || reason == ENOTDIR) refuseFull(target_);
  refuse(target_, std::strerror(reason));
}

}  // namespace limen
