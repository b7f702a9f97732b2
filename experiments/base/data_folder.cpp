// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/data_folder.h"

#include <filesystem>

namespace limen {

std::string dataFolder() {
  namespace fs = std::filesystem;
  std::error_code code;
  const fs::path folder = fs::read_symlink("/proc/self/exe", code).parent_path();
  if (!code && folder.filename() == "limen" && folder.parent_path().filename() == "lib") {
    const fs::path installed = folder.parent_path().parent_path() / "share" / "limen";
    if (fs::exists(installed / "experiments" / "features.yaml", code)) return installed.string();
  }
  return LIMEN_SOURCE_DIR;
}

}  // namespace limen
