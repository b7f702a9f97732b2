// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/results_folder.h"

#include <fmt/format.h>

#include "experiments/base/error.h"

namespace limen::viewer {

namespace fs = std::filesystem;

void makeFolder(const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed)
    throw Error("cannot create this folder: " + failed.message(), folder.string(),
                "choose another one with --results");
}

fs::path freshName(const fs::path& folder, const std::string& stem, const std::string& extension) {
  for (int number = 1; number < 100000; ++number) {
    const fs::path path = folder / fmt::format("{}_{:03}{}", stem, number, extension);
    if (!fs::exists(path)) return path;
  }
  throw Error("no free name for another " + stem, folder.string(), "move older files elsewhere");
}

}  // namespace limen::viewer
