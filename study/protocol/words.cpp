// SPDX-License-Identifier: BSD-3-Clause
#include "study/protocol/words.h"

#include <filesystem>
#include <set>
#include <stdexcept>

#include "experiments/base/data_folder.h"
#include "experiments/base/hash.h"
#include "experiments/base/input_files.h"
#include "experiments/base/problems.h"
#include "experiments/base/shipped_files.h"
#include "experiments/base/text.h"
#include "experiments/base/yaml_tree.h"

namespace limen::embedded {
extern const char* const kEnglishWords;
}

namespace limen::study {
namespace {

/// Names in braces.
std::set<std::string> placeholdersOf(const std::string& text) {
  std::set<std::string> out;
  for (size_t open = text.find('{'); open != std::string::npos; open = text.find('{', open + 1)) {
    const size_t close = text.find('}', open);
    if (close == std::string::npos) break;
    out.insert(text.substr(open + 1, close - open - 1));
  }
  return out;
}

std::string listed(const std::set<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "{" : ", {") + name + "}";
  return out.empty() ? "none" : out;
}

}  // namespace

Words Words::parse(const std::string& text, const std::string& path) {
  const bool isEnglish = path.empty();
  Words out;
  out.path_ = path;
  out.hash_ = sha256(text);
  Problems problems(path);
  const YamlNode root = parseYaml(text, path);
  if (root.kind != YamlNode::Kind::Map)
    problems.add(root.mark, "the file holds " + root.describe(),
                 "give a map like that of study/words/english.yaml");
  std::vector<std::string> known;
  if (!isEnglish)
    for (const auto& [key, words] : english().all()) known.push_back(key);
  for (const auto& [key, value] : root.members) {
    if (value.kind != YamlNode::Kind::Scalar || value.text.empty()) {
      problems.add(value.mark, "'" + key.text + "' is " + value.describe(), "give a text");
      continue;
    }
    out.texts_[key.text] = value.text;
    if (isEnglish) continue;
    const auto original = english().all().find(key.text);
    if (original == english().all().end()) {
      problems.add(key.mark, "no text '" + key.text + "' is shown", suggest(key.text, known));
      continue;
    }
    const std::set<std::string> wanted = placeholdersOf(original->second), has = placeholdersOf(value.text);
    if (wanted != has)
      problems.add(value.mark, "'" + key.text + "' has the placeholders " + listed(has),
                   "the English text has " + listed(wanted));
  }
  for (const std::string& key : known)
    if (!root.find(key) && root.kind == YamlNode::Kind::Map)
      problems.add(root.mark, "'" + key + "' is missing", "in English: " + english()[key]);
  problems.throwIfAny();
  return out;
}

const Words& Words::english() {
  static const Words kWords = parse(embedded::kEnglishWords, "");
  return kWords;
}

const std::string& Words::operator[](std::string_view key) const {
  const auto found = texts_.find(key);
  if (found == texts_.end()) throw std::logic_error("no such text: " + std::string(key));
  return found->second;
}

std::string Words::filled(std::string_view key,
                          const std::vector<std::pair<std::string, std::string>>& values) const {
  std::string out = (*this)[key];
  for (const auto& [name, value] : values) {
    const std::string placeholder = "{" + name + "}";
    for (size_t at = out.find(placeholder); at != std::string::npos;
         at = out.find(placeholder, at + value.size()))
      out.replace(at, placeholder.size(), value);
  }
  return out;
}

Words readWords(const std::string& nameOrPath, const std::string& folder) {
  std::error_code ignored;
  const std::filesystem::path beside = std::filesystem::path(folder) / nameOrPath;
  const std::string path = std::filesystem::is_regular_file(beside, ignored)
                               ? beside.string()
                               : findShipped(nameOrPath, dataFolder() + "/study/words", "language");
  protectInput(path);
  return Words::parse(readTextFile(path), path);
}

}  // namespace limen::study
