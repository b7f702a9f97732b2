// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/selection_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/base/text.h"
#include "experiments/measured_quantities.h"

namespace limen::experiments {
namespace {

using Kind = YamlNode::Kind;

void addOnce(std::vector<std::string>& list, const std::string& name) {
  if (std::find(list.begin(), list.end(), name) == list.end()) list.push_back(name);
}

}  // namespace

SelectionReader::SelectionReader(const Descriptor& descriptor, const Catalogue& catalogue, Problems& problems)
    : problems_(problems),
      files_(descriptor.path),
      reader_(problems, files_),
      catalogue_(catalogue),
      imageParameters_(ImageSize::table().parameters()) {
  for (const Entry& entry : descriptor.techniques) addOnce(techniques_, entry.name);
  for (const Entry& entry : descriptor.scenes) addOnce(scenes_, entry.name);
  quantities_ = descriptor.metricNames;
  for (const store::QuantityRow& row : commonQuantities()) quantities_.push_back(row.name);
  const std::vector<std::string> counters = counterNames(catalogue, techniques_);
  quantities_.insert(quantities_.end(), counters.begin(), counters.end());
}

std::string SelectionReader::readName(const YamlNode& map, const char* key,
                                      const std::vector<std::string>& known, const char* what) {
  const YamlNode* node = map.find(key);
  if (!node) return {};
  const auto name = reader_.values().text(*node, key);
  if (!name) return {};
  if (std::find(known.begin(), known.end(), *name) != known.end()) return *name;
  problems_.add(node->mark, fmt::format("'{}' is not a {} of this descriptor", *name, what),
                suggest(*name, known));
  return {};
}

std::vector<DeclaredAt> SelectionReader::declarations(const std::string& technique,
                                                      const std::string& scene) const {
  std::vector<DeclaredAt> out;
  const auto take = [&](const std::vector<Parameter>& parameters) {
    for (DeclaredAt& at : flatten(parameters)) out.push_back(std::move(at));
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
  const std::vector<DeclaredAt> declared = declarations(technique, scene);
  for (const auto& [key, value] : node->members) readCondition(key.text, key, value, declared, out);
  return out;
}

void SelectionReader::readCondition(const std::string& path, const YamlNode& key, const YamlNode& value,
                                    const std::vector<DeclaredAt>& declared, Selection& out) {
  if (value.kind == Kind::Map) {
    for (const auto& [inner, innerValue] : value.members)
      readCondition(inner.text == "kind" ? path : joinPath(path, inner.text), inner, innerValue, declared,
                    out);
    return;
  }
  std::vector<const DeclaredAt*> candidates;
  std::vector<std::string> known;
  for (const DeclaredAt& at : declared) {
    if (at.path == path) candidates.push_back(&at);
    addOnce(known, at.path);
    const std::vector<std::string>& former = at.parameter->formerNames;
    if (candidates.empty() && std::find(former.begin(), former.end(), path) != former.end()) {
      problems_.add(key.mark, "no technique or scene selected here has a parameter '" + path + "'",
                    "it is now '" + at.path + "'");
      return;
    }
  }
  if (candidates.empty()) {
    problems_.add(key.mark, "no technique or scene selected here has a parameter '" + path + "'",
                  suggest(path, known));
    return;
  }
  if (isShorthand(value, *candidates[0]->parameter)) {
    const Parameter& member = shorthandOf(*candidates[0]->parameter);
    if (const auto read = reader_.values().value(value, member)) out[joinPath(path, member.name)] = *read;
    return;
  }
  const auto fitting = std::find_if(candidates.begin(), candidates.end(), [&](const DeclaredAt* at) {
    return ValueReader::fits(value, *at->parameter);
  });
  const DeclaredAt* meant = fitting == candidates.end() ? candidates[0] : *fitting;
  if (const auto read = reader_.values().value(value, *meant->parameter)) out[path] = *read;
}

}  // namespace limen::experiments
