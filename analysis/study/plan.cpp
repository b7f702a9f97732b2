// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/plan.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "analysis/output/text_output.h"
#include "experiments/base/text.h"
#include "experiments/base/yaml_json.h"

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

/// Units of what a procedure chooses, by name.
std::map<std::string, std::string> unitsOf(const YamlNode& procedure) {
  if (const YamlNode* parts = procedure.find("procedures"); parts && !parts->items.empty())
    return unitsOf(parts->items.front());
  const std::string usual = textOf(procedure.find("type")) == "quest" ? "log10" : "";
  std::map<std::string, std::string> out;
  const auto take = [&](const YamlNode& axis) {
    const std::string unit = textOf(axis.find("unit"), usual);
    if (!unit.empty()) out[textOf(axis.find("name"), "stimulus")] = unit;
  };
  const YamlNode* stimulus = procedure.find("stimulus");
  if (!stimulus) return out;
  if (stimulus->kind == YamlNode::Kind::Map) take(*stimulus);
  for (const YamlNode& axis : stimulus->items)
    if (axis.kind == YamlNode::Kind::Map) take(axis);
  return out;
}

/// The function that a procedure with one axis assumes, with the threshold where it has its own; none of
/// staircases and of models that are no sigmoid.
std::optional<AssumedFunction> assumedByProcedure(const YamlNode& procedure, const std::string& variable) {
  const std::string type = textOf(procedure.find("type"));
  const auto value = [&](const char* key, double otherwise) {
    const std::string text = textOf(procedure.find(key));
    return text.empty() ? otherwise : std::strtod(text.c_str(), nullptr);
  };
  AssumedFunction out;
  out.variable = variable;
  if (type == "quest") {
    const double guess = value("gamma", 0.5), lapse = value("delta", 0.01) * (1.0 - guess);
    out.sigmoid = "gumbel";
    out.level = (value("threshold_probability", 0.82) - guess) / (1.0 - guess - lapse);
    return out;
  }
  if (type != "psi" && type != "quest_plus") return {};
  const std::string model = textOf(procedure.find("model"), type == "psi" ? "logistic" : "weibull_db");
  if (model == "sigmoid") {
    out.sigmoid = textOf(procedure.find("family"), "logistic");
    out.axis = textOf(procedure.find("axis"), out.sigmoid == "weibull" ? "log" : "linear");
  } else if (model.rfind("weibull", 0) == 0) {
    out.sigmoid =
        model == "weibull" ? "weibull" : "gumbel";  // a Weibull of what dB and log10 units stand for
    out.axis = model == "weibull" ? "log" : "linear";
    out.level = -std::expm1(-1.0);
  } else if (model == "logistic" || model == "normal") {
    out.sigmoid = model;
  } else {
    return {};
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
    out.units = unitsOf(*procedure);
    out.procedure = toJson(*procedure);
    if (out.axes.size() == 1) out.assumed = assumedByProcedure(*procedure, out.axes.front());
  }
  if (const YamlNode* titles = node.find("titles"))
    for (const YamlMember& title : titles->members) out.titles[title.key.text] = title.value.text;
  if (const YamlNode* factors = node.find("factors"))
    for (const YamlMember& factor : factors->members) out.factors.push_back(factorOf(factor));
  return out;
}

}  // namespace

std::string StudyPart::titleOf(const std::string& variable) const {
  const auto title = titles.find(variable), unit = units.find(variable);
  std::string out = title != titles.end() ? title->second : levelTitle(variable);
  if (unit != units.end() && out.find('(') == std::string::npos) out += " (" + unit->second + ")";
  return out;
}

std::string levelTitle(const std::string& level) {
  std::string out = level;
  std::replace(out.begin(), out.end(), '_', ' ');
  return out;
}

std::string conditionTitle(const StudyPart& part, const std::map<std::string, std::string>& condition) {
  std::vector<std::string> words;
  for (const StudyFactor& factor : part.factors)
    if (const auto own = condition.find(factor.name); own != condition.end())
      words.push_back((finiteNumber(own->second) ? levelTitle(factor.name) + " " : "") +
                      levelTitle(own->second));
  return join(words);
}

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
    for (StudyPart& part : out.parts)
      if (auto assumed = assumedOf(*simulation, part.name)) part.assumed = std::move(assumed);
  if (const YamlNode* rules = root.find("exclusions"))
    for (const YamlMember& rule : rules->members)
      out.exclusions.push_back({rule.key.text, std::strtod(rule.value.text.c_str(), nullptr)});
  return out;
}

}  // namespace limen::analysis
