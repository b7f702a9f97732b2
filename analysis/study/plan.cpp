// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/plan.h"

#include <algorithm>
#include <cstdlib>

#include "base/yaml_tree.h"

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

StudyPart partOf(const YamlNode& node, const std::string& name) {
  StudyPart out;
  out.name = name;
  if (const YamlNode* task = node.find("task")) {
    out.task = textOf(task->find("type"));
    out.alternatives = wholeOf(task->find("alternatives"), 2);
  }
  out.adaptive = node.find("procedure") != nullptr;
  if (const YamlNode* factors = node.find("factors"))
    for (const YamlMember& factor : factors->members) out.factors.push_back(factorOf(factor));
  return out;
}

}  // namespace

size_t StudyPlan::partNamed(const std::string& part) {
  const auto found =
      std::find_if(parts.begin(), parts.end(), [&](const StudyPart& one) { return one.name == part; });
  if (found != parts.end()) return static_cast<size_t>(found - parts.begin());
  parts.push_back({part, {}, 2, false, {}});
  return parts.size() - 1;
}

StudyPlan readStudyPlan(const store::StudyProtocol& protocol) {
  StudyPlan out;
  out.name = protocol.name;
  out.hash = protocol.hash;
  out.title = protocol.title;
  const YamlNode root = parseYaml(protocol.text, protocol.path);
  if (const YamlNode* window = root.find("window")) {
    out.widthPx = wholeOf(window->find("width_px"), out.widthPx);
    out.heightPx = wholeOf(window->find("height_px"), out.heightPx);
  }
  if (const YamlNode* parts = root.find("parts")) {
    for (const YamlNode& part : parts->items) out.parts.push_back(partOf(part, textOf(part.find("name"))));
  } else {
    out.parts.push_back(partOf(root, "main"));
  }
  if (const YamlNode* rules = root.find("exclusions"))
    for (const YamlMember& rule : rules->members)
      out.exclusions.push_back({rule.key.text, std::strtod(rule.value.text.c_str(), nullptr)});
  return out;
}

}  // namespace limen::analysis
