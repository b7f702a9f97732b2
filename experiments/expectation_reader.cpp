// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/expectation_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/base/text.h"
#include "experiments/selection_reader.h"

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

class Reader : private SelectionReader {
 public:
  Reader(const Descriptor& descriptor, const Catalogue& catalogue, Problems& problems)
      : SelectionReader(descriptor, catalogue, problems) {}

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
  void readRelation(const YamlNode& item, ExpectationStatement& statement) {
    int relations = 0;
    for (const auto& [key, relation] :
         {std::pair{"below", Relation::Below}, std::pair{"above", Relation::Above},
          std::pair{"equals", Relation::Equals}}) {
      const YamlNode* node = item.find(key);
      if (!node) continue;
      ++relations;
      statement.relation = relation;
      statement.bound = reader_.values().number(*node, key).value_or(0.0);
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
    reader_.checkKeys(item, "an expectation",
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
        reader_.checkKeys(*node, "relative_to", {"of", "scene", "where"});
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
};

}  // namespace

std::vector<ExpectationStatement> readExpectations(const YamlNode& node, const Descriptor& descriptor,
                                                   const Catalogue& catalogue, Problems& problems) {
  return Reader(descriptor, catalogue, problems).readAll(node);
}

}  // namespace limen::experiments
