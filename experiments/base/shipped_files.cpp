// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/shipped_files.h"

#include <algorithm>
#include <filesystem>

#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "experiments/base/yaml_tree.h"

namespace limen {

namespace fs = std::filesystem;

std::vector<std::pair<std::string, std::string>> shippedFiles(const std::string& folder) {
  std::vector<std::pair<std::string, std::string>> out;
  std::error_code code;
  for (fs::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code)) {
    const fs::path& path = entry->path();
    if (path.extension() != ".yaml") continue;
    const YamlNode root = parseYaml(readTextFile(path.string()), path.string());
    const YamlNode* title = root.find("title");
    out.emplace_back(path.stem().string(), title ? title->text : "");
  }
  std::sort(out.begin(), out.end());
  return out;
}

std::string findShipped(const std::string& nameOrPath, const std::string& folder, const std::string& kind) {
  std::error_code code;
  if (fs::exists(nameOrPath, code)) return nameOrPath;
  std::vector<std::string> names;
  for (const auto& [name, title] : shippedFiles(folder)) names.push_back(name);
  if (std::find(names.begin(), names.end(), nameOrPath) == names.end())
    throw Error("no file and no shipped " + kind + " '" + nameOrPath + "'", "", suggest(nameOrPath, names));
  return folder + "/" + nameOrPath + ".yaml";
}

}  // namespace limen
