// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study_page/staged_folder.h"

#include <unistd.h>

#include <system_error>
#include <vector>

#include "experiments/base/error.h"

namespace limen::analysis {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& folder, const std::error_code& error) {
  throw Error("the folder cannot be made: " + error.message(), folder.string(), "choose another with -o");
}

}  // namespace

StagedFolder::StagedFolder(const std::string& target) : target_(fs::absolute(target).lexically_normal()) {
  if (!target_.has_filename()) target_ = target_.parent_path();
  std::error_code error;
  fs::create_directories(target_.parent_path(), error);
  if (error) refuse(target_, error);
  // Beside the target, so that moving is renaming.
  staging_ =
      target_.parent_path() / ("." + target_.filename().string() + ".part-" + std::to_string(getpid()));
  fs::remove_all(staging_, error);
  fs::create_directory(staging_, error);
  if (error) refuse(target_, error);
}

StagedFolder::~StagedFolder() {
  std::error_code error;
  fs::remove_all(staging_, error);
}

void StagedFolder::putInPlace() const {
  std::error_code error;
  fs::create_directories(target_, error);
  if (error) refuse(target_, error);
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(staging_)) {
    const fs::path to = target_ / fs::relative(entry.path(), staging_);
    if (entry.is_directory()) {
      fs::create_directories(to, error);
      if (error) refuse(to, error);
    } else {
      files.push_back(entry.path());
    }
  }
  for (const fs::path& file : files) {
    const fs::path to = target_ / fs::relative(file, staging_);
    fs::rename(file, to, error);
    if (error)
      throw Error("cannot be written: " + error.message(), to.string(),
                  "check the rights on its folder and the space on the disk");
  }
}

}  // namespace limen::analysis
