// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study_page/session_facts.h"

#include <algorithm>
#include <cstdlib>

#include "experiments/base/text.h"
#include "experiments/base/yaml_tree.h"

namespace limen::analysis {
namespace {

std::string textAt(const YamlNode& node, const char* key, const std::string& otherwise = {}) {
  const YamlNode* found = node.find(key);
  return found && found->kind == YamlNode::Kind::Scalar ? found->text : otherwise;
}

std::vector<std::string> textsOf(const YamlNode* node) {
  std::vector<std::string> out;
  if (node)
    for (const YamlNode& item : node->items) out.push_back(item.text);
  return out;
}

/// `order: shuffle`, `order: {kind: shuffle, ...}`, or levels in a list.
std::string orderOf(const YamlNode* node, const std::string& otherwise) {
  if (!node) return otherwise;
  if (node->kind == YamlNode::Kind::Map) return textAt(*node, "kind", otherwise);
  return node->kind == YamlNode::Kind::List ? join(textsOf(node)) : node->text;
}

PartText partOf(const YamlNode& node, const std::string& name) {
  PartText out;
  out.name = name;
  if (const YamlNode* task = node.find("task")) {
    out.question = textAt(*task, "question");
    out.answers = textsOf(task->find("answers"));
    if (const YamlNode* scale = task->find("severity")) {
      out.severityQuestion = textAt(*scale, "question");
      out.severityLabels = textsOf(scale->find("labels"));
    }
    if (const YamlNode* scale = task->find("confidence"))
      out.confidenceLabels = textsOf(scale->find("labels"));
  }
  out.order = orderOf(node.find("order"), "shuffle");
  if (const YamlNode* blocks = node.find("blocks")) {
    out.blockBy = textAt(*blocks, "by");
    out.blockOrder = orderOf(blocks->find("order"), "fixed");
  }
  if (const YamlNode* breaks = node.find("breaks"))
    out.breakEveryTrials = std::atoi(textAt(*breaks, "every_trials").c_str());
  if (const YamlNode* practice = node.find("practice"))
    out.practiceFeedback = textAt(*practice, "feedback") == "true";
  if (const YamlNode* procedure = node.find("procedure")) out.procedure = textAt(*procedure, "type");
  return out;
}

}  // namespace

const PartText* ProtocolText::part(const std::string& name) const {
  const auto found =
      std::find_if(parts.begin(), parts.end(), [&](const PartText& one) { return one.name == name; });
  return found == parts.end() ? nullptr : &*found;
}

ProtocolText readProtocolText(const store::StudyProtocol& protocol) {
  const YamlNode root = parseYaml(protocol.text, protocol.path);
  ProtocolText out;
  out.question = textAt(root, "question");
  out.source = textAt(root, "source");
  out.partOrder = orderOf(root.find("part_order"), "fixed");
  if (const YamlNode* window = root.find("window")) out.background = textAt(*window, "background");
  if (const YamlNode* parts = root.find("parts")) {
    for (const YamlNode& part : parts->items) out.parts.push_back(partOf(part, textAt(part, "name")));
  } else {
    out.parts.push_back(partOf(root, "main"));
  }
  if (const YamlNode* form = root.find("form"))
    for (const YamlNode& field : form->items)
      out.form.push_back({textAt(field, "name"), textAt(field, "label"), textsOf(field.find("choices"))});
  return out;
}

}  // namespace limen::analysis
