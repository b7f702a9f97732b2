// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/plan.h"

#include <algorithm>
#include <cstdlib>

#include "experiments/base/yaml_tree.h"

namespace limen::analysis {
namespace {

std::string textOf(const YamlNode* node, const std::string& otherwise = {}) {
  return node && node->kind == YamlNode::Kind::Scalar ? node->text : otherwise;
}

int wholeOf(const YamlNode* node, int otherwise) {
  const std::string text = textOf(node);
  return text.empty() ? otherwise : std::atoi(text.c_str());
}

StudyFactor factorOf(const YamlMember& member) {
  StudyFactor out{member.key.text, {}};
  for (const YamlNode& item : member.value.items) out.levels.push_back(item.text);
  for (const YamlMember& level : member.value.members) out.levels.push_back(level.key.text);
  return out;
}

/// Names of what a procedure chooses, in the order in which it gives their values.
std::vector<std::string> axesOf(const YamlNode& procedure) {
  const YamlNode* parts = procedure.find("procedures");  // of an interleaved one: all have the same axes
  if (parts && !parts->items.empty()) {
    std::vector<std::string> out = axesOf(parts->items.front());
    out.insert(out.begin(), "");
    return out;
  }
  const YamlNode* stimulus = procedure.find("stimulus");
  std::vector<std::string> out;
  if (stimulus)
    for (const YamlNode& axis : stimulus->items)
      if (axis.kind == YamlNode::Kind::Map) out.push_back(textOf(axis.find("name"), "stimulus"));
  if (out.empty()) out.push_back(stimulus ? textOf(stimulus->find("name"), "stimulus") : "stimulus");
  return out;
}

/// Of the block's keys for all parts, and those of this part, which go before. None where the variable is an
/// expression, or F is given itself.
std::optional<AssumedFunction> assumedOf(const YamlNode& simulation, const std::string& part) {
  const YamlNode* parts = simulation.find("parts");
  const YamlNode* own = parts ? parts->find(part) : nullptr;
  const auto value = [&](const char* key, const std::string& otherwise) {
    return textOf(own ? own->find(key) : nullptr, textOf(simulation.find(key), otherwise));
  };
  AssumedFunction out;
  out.variable = value("variable", "");
  const bool detected =
      (own && own->find("detected")) || (simulation.find("detected") && !simulation.find("variable"));
  if (out.variable.empty() || out.variable[0] == '=' || detected) return {};
  out.sigmoid = value("sigmoid", out.sigmoid);
  out.axis = out.sigmoid == "weibull" ? "log" : value("axis", out.axis);
  out.direction = value("direction", out.direction);
  out.level = std::strtod(value("level", "0.5").c_str(), nullptr);
  // Simulated observers' falling F is 1 - F of the rising one, fitted ones' that of the mirrored axis.
  if (out.direction == "falling") {
    if (out.sigmoid == "gumbel" || out.sigmoid == "weibull")
      out.sigmoid = "reversed_gumbel";
    else if (out.sigmoid == "reversed_gumbel")
      out.sigmoid = "gumbel";
  }
  return out;
}

StudyPart partOf(const YamlNode& node, const std::string& name) {
  StudyPart out;
  out.name = name;
  if (const YamlNode* task = node.find("task")) {
    out.task = textOf(task->find("type"));
    out.alternatives = wholeOf(task->find("alternatives"), 2);
  }
  if (const YamlNode* procedure = node.find("procedure")) {
    out.adaptive = true;
    out.axes = axesOf(*procedure);
  }
  if (const YamlNode* factors = node.find("factors"))
    for (const YamlMember& factor : factors->members) out.factors.push_back(factorOf(factor));
  return out;
}

}  // namespace

const StudyPart& StudyPlan::part(const std::string& wanted) const {
  return *std::find_if(parts.begin(), parts.end(), [&](const StudyPart& one) { return one.name == wanted; });
}

size_t StudyPlan::partNamed(const std::string& part) {
  const auto found =
      std::find_if(parts.begin(), parts.end(), [&](const StudyPart& one) { return one.name == part; });
  if (found != parts.end()) return static_cast<size_t>(found - parts.begin());
  StudyPart unknown;
  unknown.name = part;
  parts.push_back(std::move(unknown));
  return parts.size() - 1;
}

StudyPlan readStudyPlan(const store::StudyProtocol& protocol, const std::string& store) {
  StudyPlan out;
  out.name = protocol.name;
  out.hash = protocol.hash;
  out.title = protocol.title;
  const YamlNode root = parseYaml(protocol.text, store + " (protocol " + protocol.name + ")");
  if (const YamlNode* window = root.find("window")) {
    out.widthPx = wholeOf(window->find("width_px"), out.widthPx);
    out.heightPx = wholeOf(window->find("height_px"), out.heightPx);
  }
  if (const YamlNode* parts = root.find("parts")) {
    for (const YamlNode& part : parts->items) out.parts.push_back(partOf(part, textOf(part.find("name"))));
  } else {
    out.parts.push_back(partOf(root, "main"));
  }
  if (const YamlNode* simulation = root.find("simulation"))
    for (StudyPart& part : out.parts) part.assumed = assumedOf(*simulation, part.name);
  if (const YamlNode* rules = root.find("exclusions"))
    for (const YamlMember& rule : rules->members)
      out.exclusions.push_back({rule.key.text, std::strtod(rule.value.text.c_str(), nullptr)});
  return out;
}

}  // namespace limen::analysis
