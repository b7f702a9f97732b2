// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/answer_tables/source.h"

#include <filesystem>
#include <fstream>

#include "experiments/base/error.h"

namespace limen::analysis {

bool isDatabase(const std::string& path) {
  static const std::string kMagic("SQLite format 3\0", 16);
  if (std::filesystem::is_directory(path))
    throw Error("is a folder", path, "name the result store or the CSV file in it");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error("no such file, or not readable", path, "name a result store or a CSV file");
  std::string start(kMagic.size(), '\0');
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  return in.gcount() == static_cast<std::streamsize>(start.size()) && start == kMagic;
}

}  // namespace limen::analysis
