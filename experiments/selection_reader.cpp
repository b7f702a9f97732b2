// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/selection_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/base/text.h"

namespace limen::experiments {
namespace {

using Kind = YamlNode::Kind;

void addOnce(std::vector<std::string>& list, const std::string& name) {
  if (std::find(list.begin(), list.end(), name) == list.end()) list.push_back(name);
}

}  // namespace

SelectionReader::SelectionReader(const Descriptor& descriptor, const Catalogue& catalogue,
                                 const std::vector<Parameter>& imageParameters, Problems& problems)
    : problems_(problems),
      files_(descriptor.path),
      values_(problems, files_),
      catalogue_(catalogue),
      imageParameters_(imageParameters) {
  for (const Entry& entry : descriptor.techniques) addOnce(techniques_, entry.name);
  for (const Entry& entry : descriptor.scenes) addOnce(scenes_, entry.name);
  quantities_ = descriptor.metricNames;
  for (const std::string& name : measurementNames(catalogue)) quantities_.push_back(name);
  const std::vector<std::string> counters = counterNames(catalogue, techniques_);
  quantities_.insert(quantities_.end(), counters.begin(), counters.end());
}

void SelectionReader::checkKeys(const YamlNode& map, const char* what,
                                const std::vector<std::string>& known) {
  for (const auto& [key, value] : map.members)
    if (std::find(known.begin(), known.end(), key.text) == known.end())
      problems_.add(key.mark, fmt::format("unknown key '{}' of {}", YamlNode(key).text, what),
                    suggest(key.text, known));
}

std::string SelectionReader::readName(const YamlNode& map, const char* key,
                                      const std::vector<std::string>& known, const char* what) {
  const YamlNode* node = map.find(key);
  if (!node) return {};
  const auto name = values_.text(*node, key);
  if (!name) return {};
  if (std::find(known.begin(), known.end(), *name) != known.end()) return *name;
  problems_.add(node->mark, fmt::format("'{}' is no {} of this descriptor", *name, what),
                suggest(*name, known));
  return {};
}

std::vector<const Parameter*> SelectionReader::declarations(const std::string& technique,
                                                            const std::string& scene, const std::string& name,
                                                            std::vector<std::string>& known) const {
  std::vector<const Parameter*> out;
  const auto take = [&](const std::vector<Parameter>& parameters) {
    for (const Parameter& parameter : parameters) {
      if (parameter.name == name) out.push_back(&parameter);
      addOnce(known, parameter.name);
    }
  };
  for (const std::string& candidate : techniques_)
    if (technique.empty() || technique == candidate) take(catalogue_.techniques.at(candidate).parameters);
  for (const std::string& candidate : scenes_)
    if (scene.empty() || scene == candidate) take(catalogue_.scenes.at(candidate).parameters);
  take(imageParameters_);
  return out;
}

Selection SelectionReader::readWhere(const YamlNode& map, const std::string& technique,
                                     const std::string& scene) {
  Selection out;
  const YamlNode* node = map.find("where");
  if (!node) return out;
  if (node->kind != Kind::Map || node->members.empty()) {
    problems_.add(node->mark, "'where' is " + (node->kind == Kind::Map ? "empty" : node->describe()),
                  "write it as a map: {parameter: value}");
    return out;
  }
  for (const auto& [key, value] : node->members) {
    std::vector<std::string> known;
    const auto candidates = declarations(technique, scene, key.text, known);
    if (candidates.empty()) {
      problems_.add(key.mark,
                    fmt::format("no technique or scene meant here has a parameter '{}'", YamlNode(key).text),
                    suggest(key.text, known));
      continue;
    }
    const auto fitting = std::find_if(
        candidates.begin(), candidates.end(),
        [&node = value](const Parameter* parameter) { return ValueReader::fits(node, *parameter); });
    if (const auto read = values_.value(value, fitting == candidates.end() ? *candidates[0] : **fitting))
      out[key.text] = *read;
  }
  return out;
}

}  // namespace limen::experiments
