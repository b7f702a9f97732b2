// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/expectation_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "base/value_reader.h"

namespace limen::experiments {
namespace {

using Kind = YamlNode::Kind;
using Relation = ExpectationStatement::Relation;

std::string selectionText(const std::string& technique, const std::string& scene, const Selection& where) {
  std::string out;
  if (!technique.empty()) out += " of " + technique;
  if (!scene.empty()) out += " in " + scene;
  std::vector<std::string> parts;
  for (const auto& [name, value] : where) parts.push_back(name + "=" + toText(value));
  if (!parts.empty()) out += " where " + join(parts);
  return out;
}

std::string statementText(const ExpectationStatement& statement) {
  const char* relation = statement.relation == Relation::Below   ? "below"
                         : statement.relation == Relation::Above ? "above"
                                                                 : "equals";
  std::string out = statement.metric + selectionText(statement.technique, statement.scene, statement.where) +
                    " " + relation + " " + shortestNumber(statement.bound);
  if (statement.relativeTo)
    out += " x that" + selectionText(statement.relativeTo->technique, statement.relativeTo->scene,
                                     statement.relativeTo->where);
  return out;
}

class Reader {
 public:
  Reader(const Descriptor& descriptor, const Catalogue& catalogue,
         const std::vector<Parameter>& imageParameters, Problems& problems)
      : catalogue_(catalogue),
        imageParameters_(imageParameters),
        problems_(problems),
        files_(descriptor.path),
        values_(problems, files_) {
    for (const Entry& entry : descriptor.techniques) addOnce(techniques_, entry.name);
    for (const Entry& entry : descriptor.scenes) addOnce(scenes_, entry.name);
    quantities_ = descriptor.metricNames;
    quantities_.insert(quantities_.end(), catalogue.measurements.begin(), catalogue.measurements.end());
    const std::vector<std::string> counters = counterNames(catalogue, techniques_);
    quantities_.insert(quantities_.end(), counters.begin(), counters.end());
  }

  std::vector<ExpectationStatement> readAll(const YamlNode& node) {
    std::vector<ExpectationStatement> out;
    if (node.kind != Kind::List || node.items.empty()) {
      problems_.add(node.mark, "'expect' is " + (node.kind == Kind::List ? "an empty list" : node.describe()),
                    "write a list: - {metric: rmse, below: 0.01}");
      return out;
    }
    for (const YamlNode& item : node.items) out.push_back(read(item));
    return out;
  }

 private:
  static void addOnce(std::vector<std::string>& list, const std::string& name) {
    if (std::find(list.begin(), list.end(), name) == list.end()) list.push_back(name);
  }

  void checkKeys(const YamlNode& map, const char* what, const std::vector<std::string>& known) {
    for (const auto& [key, value] : map.members)
      if (std::find(known.begin(), known.end(), key.text) == known.end())
        problems_.add(key.mark, fmt::format("unknown key '{}' of {}", YamlNode(key).text, what),
                      suggest(key.text, known));
  }

  std::string readName(const YamlNode& map, const char* key, const std::vector<std::string>& known,
                       const char* what) {
    const YamlNode* node = map.find(key);
    if (!node) return {};
    const auto name = values_.text(*node, key);
    if (!name) return {};
    if (std::find(known.begin(), known.end(), *name) != known.end()) return *name;
    problems_.add(node->mark, fmt::format("'{}' is no {} of this descriptor", *name, what),
                  suggest(*name, known));
    return {};
  }

  /// Declarations that `name` may mean for runs of `technique` (any if empty) in `scene`, nearest meaning
  /// first.
  std::vector<const Parameter*> declarations(const std::string& technique, const std::string& scene,
                                             const std::string& name, std::vector<std::string>& known) const {
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

  Selection readWhere(const YamlNode& map, const std::string& technique, const std::string& scene) {
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
        problems_.add(
            key.mark,
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

  void readRelation(const YamlNode& item, ExpectationStatement& statement) {
    int relations = 0;
    for (const auto& [key, relation] :
         {std::pair{"below", Relation::Below}, std::pair{"above", Relation::Above},
          std::pair{"equals", Relation::Equals}}) {
      const YamlNode* node = item.find(key);
      if (!node) continue;
      ++relations;
      statement.relation = relation;
      statement.bound = values_.number(*node, key).value_or(0.0);
    }
    if (relations != 1)
      problems_.add(item.mark, fmt::format("an expectation with {} of 'below', 'above', 'equals'", relations),
                    "give exactly one of them");
  }

  ExpectationStatement read(const YamlNode& item) {
    ExpectationStatement statement;
    statement.mark = item.mark;
    if (item.kind != Kind::Map) {
      problems_.add(item.mark, "an expectation is " + item.describe(),
                    "write it as a map: {metric: rmse, below: 0.01}");
      return statement;
    }
    checkKeys(item, "an expectation",
              {"metric", "of", "scene", "where", "below", "above", "equals", "relative_to"});
    if (!item.find("metric"))
      problems_.add(item.mark, "'metric' of an expectation is missing", suggest("", quantities_));
    statement.metric = readName(item, "metric", quantities_, "metric");
    statement.technique = readName(item, "of", techniques_, "technique");
    statement.scene = readName(item, "scene", scenes_, "scene");
    statement.where = readWhere(item, statement.technique, statement.scene);
    readRelation(item, statement);
    if (const YamlNode* node = item.find("relative_to")) {
      if (node->kind != Kind::Map || node->members.empty()) {
        problems_.add(node->mark,
                      "'relative_to' is " + (node->kind == Kind::Map ? "empty" : node->describe()),
                      "write it as a map: {of: TECHNIQUE, where: {parameter: value}}");
      } else {
        checkKeys(*node, "relative_to", {"of", "scene", "where"});
        ExpectationStatement::Baseline baseline;
        baseline.technique = readName(*node, "of", techniques_, "technique");
        baseline.scene = readName(*node, "scene", scenes_, "scene");
        baseline.where =
            readWhere(*node, baseline.technique.empty() ? statement.technique : baseline.technique,
                      baseline.scene.empty() ? statement.scene : baseline.scene);
        statement.relativeTo = std::move(baseline);
      }
    }
    statement.text = statementText(statement);
    return statement;
  }

  const Catalogue& catalogue_;
  const std::vector<Parameter>& imageParameters_;
  Problems& problems_;
  FileFinder files_;
  ValueReader values_;
  std::vector<std::string> techniques_, scenes_, quantities_;
};

}  // namespace

std::vector<ExpectationStatement> readExpectations(const YamlNode& node, const Descriptor& descriptor,
                                                   const Catalogue& catalogue,
                                                   const std::vector<Parameter>& imageParameters,
                                                   Problems& problems) {
  return Reader(descriptor, catalogue, imageParameters, problems).readAll(node);
}

}  // namespace limen::experiments
