// SPDX-License-Identifier: BSD-3-Clause
#include "study/protocol/part_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "study/protocol/conditions.h"
#include "study/protocol/expression.h"

namespace limen::study {

using Kind = YamlNode::Kind;

const std::vector<std::string>& partKeys() {
  static const std::vector<std::string> kKeys = {"task",   "stimulus",  "variables", "factors",
                                                 "trials", "procedure", "blocks",    "order",
                                                 "breaks", "practice",  "items",     "titles"};
  return kKeys;
}

OrderSetting readOrder(NodeReader& reader, const YamlNode& node, const std::string& key,
                       const std::vector<std::string>& limits) {
  OrderSetting out;
  if (node.kind == Kind::Scalar) {
    if (const auto kind = reader.choice(node, key, namesOf<OrderKind>()))
      out.kind = fromText<OrderKind>(*kind);
    return out;
  }
  if (!reader.isMap(node, "'" + key + "'", "{kind: shuffle, at_most_in_a_row: {change: 4}}")) return out;
  reader.checkKeys(node, key, {"kind", "at_most_in_a_row"});
  reader.take(node, "kind", out.kind);
  const YamlNode* runs = node.find("at_most_in_a_row");
  if (!runs || !reader.isMap(*runs, "'at_most_in_a_row'", "{change: 4}")) return out;
  if (out.kind != OrderKind::Shuffle)
    reader.problems().add(
        runs->mark,
        "'at_most_in_a_row' is used with the order '" + std::string(limen::toText(out.kind)) + "'",
        "only 'shuffle' can satisfy it");
  if (limits.empty())
    reader.problems().add(runs->mark, "'at_most_in_a_row' of '" + key + "'", "only 'order' has it");
  else
    reader.checkKeys(*runs, "at_most_in_a_row", limits);
  for (const auto& [name, value] : runs->members)
    if (const auto most = reader.number(value, name.text, {1, 1000000}, "trials", true))
      out.atMostInARow[name.text] = static_cast<int>(std::get<int64_t>(*most));
  return out;
}

void PartReader::readVariables(const YamlNode& node, const std::string& what, Variables& out) {
  if (!reader_.isMap(node, what, "{speed: 1.5}")) return;
  for (const auto& [key, value] : node.members) {
    if (!isVariableName(key.text))
      reader_.problems().add(key.mark, "'" + key.text + "' is not a name for a variable",
                             "a letter, then letters, digits and _");
    else if (isExpression(value) || value.kind == Kind::Null)
      reader_.problems().add(value.mark, "variable '" + key.text + "' is " + value.describe(),
                             "give a value; expressions belong in 'stimulus'");
    else
      out[key.text] = toJson(value);
  }
}

FactorLevel PartReader::readLevel(const std::string& factor, const YamlMember* named, const YamlNode& value) {
  FactorLevel out;
  if (named) {
    out.name = named->key.text;
    out.variables[factor] = toJson(named->key);
    readVariables(value, "level '" + out.name + "' of factor '" + factor + "'", out.variables);
  } else {
    out.name = reader_.values().text(value, "a level of factor '" + factor + "'").value_or("");
    if (isExpression(value))
      reader_.problems().add(value.mark, "a level of factor '" + factor + "' is an expression",
                             "give a value; expressions belong in 'stimulus'");
    out.variables[factor] = toJson(value);
  }
  return out;
}

void PartReader::readFactors(const YamlNode& node, Part& out) {
  Problems& problems = reader_.problems();
  if (!reader_.isMap(node, "'factors'", "{distance: [4, 6, 9]}")) return;
  for (const auto& [key, levels] : node.members) {
    const std::string& name = key.text;
    if (!isVariableName(name))
      problems.add(key.mark, "'" + name + "' is not a name for a factor",
                   "a letter, then letters, digits and _");
    for (const char* reserved : {"change", "item_a", "item_b"})
      if (name == reserved) problems.add(key.mark, "a factor is named '" + name + "'", "use another name");
    Factor factor{name, {}};
    std::vector<Mark> marks;
    if (levels.kind == Kind::Map) {
      for (const YamlMember& level : levels.members) {
        factor.levels.push_back(readLevel(name, &level, level.value));
        marks.push_back(level.key.mark);
      }
      if (levels.members.empty())
        problems.add(levels.mark, "factor '" + name + "' has no levels", "give two");
    } else if (reader_.isFilledList(levels, "factor '" + name + "'", "[4, 6, 9]")) {
      for (const YamlNode& level : levels.items) {
        factor.levels.push_back(readLevel(name, nullptr, level));
        marks.push_back(level.mark);
      }
    }
    for (size_t i = 0; i < factor.levels.size(); ++i) {
      const FactorLevel& level = factor.levels[i];
      const bool twice = std::any_of(factor.levels.begin(), factor.levels.begin() + static_cast<long>(i),
                                     [&](const FactorLevel& other) { return other.name == level.name; });
      if (twice)
        problems.add(marks[i], "factor '" + name + "' has level '" + level.name + "' twice", "keep one");
      for (const auto& [variable, value] : factor.levels.front().variables)
        if (!level.variables.count(variable))
          problems.add(marks[i],
                       fmt::format("level '{}' of factor '{}' sets no '{}'", level.name, name, variable),
                       "all levels of a factor set the same variables");
      for (const auto& [variable, value] : level.variables)
        if (!factor.levels.front().variables.count(variable))
          problems.add(marks[i],
                       fmt::format("level '{}' of factor '{}' sets '{}', which '{}' does not", level.name,
                                   name, variable, factor.levels.front().name),
                       "all levels of a factor set the same variables");
    }
    if (!factor.levels.empty()) out.factors.push_back(std::move(factor));
  }
}

void PartReader::checkTitles(const YamlNode& node, const Part& part) {
  const char* example = "{distance: distance (m)}";
  if (!reader_.isMap(node, "'titles'", example)) return;
  std::vector<std::string> names;
  for (const Factor& factor : part.factors) names.push_back(factor.name);
  if (procedure_)
    for (const StimulusDimension& dimension : procedure_->stimulus) names.push_back(dimension.name);
  reader_.checkKeys(node, "titles", names);
  for (const auto& [name, title] : node.members)
    if (title.kind != Kind::Scalar || title.text.empty())
      reader_.problems().add(title.mark, "the title of '" + name.text + "' is " + title.describe(),
                             std::string("give words, with the unit in brackets: ") + example);
}

void PartReader::readTrials(const YamlNode& map, Part& out) {
  if (const YamlNode* node = map.find("trials"); node && reader_.isMap(*node, "'trials'", "{change: 3}")) {
    reader_.checkKeys(
        *node, "trials",
        out.procedure ? std::vector<std::string>{"catch"} : std::vector<std::string>{"change", "catch"});
    reader_.take(*node, "change", {1, 100000}, "", out.changeRepetitions);
    reader_.take(*node, "catch", {0, 100000}, "", out.catchRepetitions);
    if (out.catchRepetitions > 0 && out.task.type != Task::YesNo && out.task.type != Task::Rating)
      reader_.problems().add(
          node->find("catch")->mark,
          "catch trials of a task '" + std::string(limen::toText(out.task.type)) + "'",
          "'yes_no' and 'rating' can have them; the others show an unchanged stimulus in every trial");
  }
}

void PartReader::readItems(const YamlNode& map, Part& out) {
  Problems& problems = reader_.problems();
  const YamlNode* node = map.find("items");
  if (out.task.type != Task::Pairwise) {
    if (node)
      problems.add(node->mark,
                   "'items' in a part with task '" + std::string(limen::toText(out.task.type)) + "'",
                   "only 'pairwise' compares items");
    return;
  }
  if (!node) {
    problems.add(map.mark, "'items' is missing", "name the factor whose levels are compared");
    return;
  }
  out.items = reader_.values().text(*node, "items").value_or("");
  std::vector<std::string> names;
  for (const Factor& factor : out.factors) names.push_back(factor.name);
  const Factor* items = findFactor(out, out.items);
  if (!items)
    problems.add(node->mark, "no factor '" + out.items + "'", suggest(out.items, names));
  else if (items->levels.size() < 2)
    problems.add(node->mark, "factor '" + out.items + "' has one level", "two or more can be compared");
}

void PartReader::readProcedure(const YamlNode& node, Part& out) {
  Problems& problems = reader_.problems();
  out.procedure = ProcedureSetting{toJson(node), node.mark};
  if (out.task.type == Task::Pairwise) {
    problems.add(node.mark, "a 'procedure' in a part that compares pairs", "pairs are shown in full");
    return;
  }
  try {
    procedure_ = study::readProcedure(out.procedure->settings, "procedure");
  } catch (const Error& error) {
    // "procedure.parameters.threshold": as far as there are such keys.
    Mark mark = node.mark;
    const YamlNode* at = &node;
    const std::string& path = error.where();
    for (size_t begin = path.find('.'); begin != std::string::npos && at;) {
      const size_t end = path.find('.', begin + 1);
      at = at->find(path.substr(begin + 1, end == std::string::npos ? end : end - begin - 1));
      if (at) mark = at->mark;
      begin = end;
    }
    problems.add(mark, error.where() + ": " + error.message(), error.hint());
    return;
  }
  const int outcomes = out.task.type == Task::Rating ? static_cast<int>(out.task.answers.size()) : 2;
  if (procedure_->outcomes != outcomes)
    problems.add(node.mark,
                 fmt::format("the procedure has {} outcomes, the task {}", procedure_->outcomes, outcomes),
                 "make them agree");
  if (!procedure_->mostTrials)
    problems.add(node.mark, "the procedure may never end", "give 'stop: {trials: ...}'");
  for (const StimulusDimension& dimension : procedure_->stimulus) {
    if (!isVariableName(dimension.name))
      problems.add(node.mark, "'" + dimension.name + "' is not a name for a variable",
                   "a letter, then letters, digits and _");
    if (!std::isfinite(dimension.minimum) || !std::isfinite(dimension.maximum))
      problems.add(node.mark, "the procedure may request any '" + dimension.name + "'",
                   "give its stimulus a minimum and a maximum");
  }
}

void PartReader::readBlocks(const YamlNode& node, Part& out) {
  Problems& problems = reader_.problems();
  out.blockOrder.kind = OrderKind::Fixed;
  if (!reader_.isMap(node, "'blocks'", "{by: presentation, order: [dynamic, static]}")) return;
  reader_.checkKeys(node, "blocks", {"by", "order"});
  reader_.takeText(node, "by", true, out.blockBy);
  std::vector<std::string> names;
  for (const Factor& factor : out.factors)
    if (factor.name != out.items) names.push_back(factor.name);
  const bool known = std::find(names.begin(), names.end(), out.blockBy) != names.end();
  if (!known && node.find("by"))
    problems.add(node.find("by")->mark, "no factor '" + out.blockBy + "' to make blocks of",
                 suggest(out.blockBy, names));
  if (known)
    for (const FactorLevel& level : findFactor(out, out.blockBy)->levels)
      out.blockLevels.push_back(level.name);
  else
    out.blockBy.clear();
  const YamlNode* order = node.find("order");
  if (!order) return;
  if (order->kind != Kind::List) {
    out.blockOrder = readOrder(reader_, *order, "order", {});
    return;
  }
  const std::vector<std::string> listed = reader_.texts(*order, "'order' of blocks", "[dynamic, static]");
  if (!known) return;
  for (size_t i = 0; i < listed.size(); ++i)
    if (std::find(out.blockLevels.begin(), out.blockLevels.end(), listed[i]) == out.blockLevels.end())
      problems.add(order->mark, "factor '" + out.blockBy + "' has no level '" + listed[i] + "'",
                   suggest(listed[i], out.blockLevels));
  for (const std::string& level : out.blockLevels)
    if (std::find(listed.begin(), listed.end(), level) == listed.end())
      problems.add(order->mark, "level '" + level + "' is missing in the order of blocks", "list all levels");
  if (listed.size() == out.blockLevels.size()) out.blockLevels = listed;
}

void PartReader::readPractice(const YamlNode& node, Part& out) {
  Problems& problems = reader_.problems();
  Practice& practice = out.practice;
  if (!reader_.isMap(node, "'practice'", "{trials: 8, feedback: true, correct: 6, rounds: 3}")) return;
  reader_.checkKeys(node, "practice", {"trials", "feedback", "correct", "rounds", "on_failure", "stimuli"});
  if (!node.find("trials"))
    problems.add(node.mark, "'trials' of practice is missing", "give it: a whole number, 0 for none");
  reader_.take(node, "trials", {0, 10000}, "", practice.trials);
  reader_.take(node, "feedback", practice.feedback);
  reader_.take(node, "correct", {0, 10000}, "trials", practice.correct);
  reader_.take(node, "rounds", {1, 100}, "", practice.rounds);
  if (const YamlNode* failure = node.find("on_failure"))
    practice.stopOnFailure = reader_.choice(*failure, "on_failure", {"stop", "continue"}) == "stop";
  if (practice.correct > practice.trials)
    problems.add(node.mark, fmt::format("{} correct answers in {} trials", practice.correct, practice.trials),
                 "ask for at most as many as there are trials");
  const bool right = out.task.type != Task::Rating && out.task.type != Task::Pairwise;
  if (!right && (practice.correct > 0 || (node.find("feedback") && practice.feedback)))
    problems.add(
        node.mark,
        "'correct' or 'feedback' in a part with task '" + std::string(limen::toText(out.task.type)) + "'",
        "its answers are neither correct nor wrong: leave 'correct' out and set 'feedback: false'");
  if (!right) practice.feedback = false;

  const YamlNode* stimuli = node.find("stimuli");
  if (!out.procedure) {
    if (stimuli) problems.add(stimuli->mark, "'stimuli' of practice without a 'procedure'", "remove it");
    return;
  }
  if (!procedure_ || practice.trials == 0) return;
  std::vector<std::string> axes;
  for (const StimulusDimension& dimension : procedure_->stimulus) axes.push_back(dimension.name);
  const std::string example = "[{" + join(axes, ": ..., ") + ": ...}]";
  if (!stimuli) {
    problems.add(node.mark, "'stimuli' of practice is missing",
                 "the procedure has none before the first answer; give them: " + example);
    return;
  }
  if (!reader_.isFilledList(*stimuli, "'stimuli' of practice", example)) return;
  for (const YamlNode& item : stimuli->items) {
    Variables variables;
    readVariables(item, "an entry of 'stimuli'", variables);
    if (item.kind == Kind::Map) reader_.checkKeys(item, "stimuli", axes);
    for (const std::string& axis : axes)
      if (item.kind == Kind::Map && !variables.count(axis))
        problems.add(item.mark, "'" + axis + "' is missing", "give every axis of the procedure: " + example);
    practice.stimuli.push_back(std::move(variables));
  }
}

Part PartReader::read(const YamlNode& map, const std::string& defaultName,
                      const std::vector<std::string>& otherKeys) {
  Problems& problems = reader_.problems();
  const size_t before = problems.size();
  procedure_.reset();
  Part out;
  out.name = defaultName;
  std::vector<std::string> keys = partKeys();
  keys.insert(keys.end(), otherKeys.begin(), otherKeys.end());
  reader_.checkKeys(map, otherKeys.size() > 1 ? "protocol" : "part", keys);
  if (otherKeys.size() == 1) reader_.takeText(map, "name", true, out.name);
  readTask(map, out);
  if (const YamlNode* node = map.find("variables")) readVariables(*node, "'variables'", out.variables);
  if (const YamlNode* node = map.find("factors")) readFactors(*node, out);
  readItems(map, out);
  if (const YamlNode* node = map.find("procedure")) readProcedure(*node, out);
  readTrials(map, out);
  if (const YamlNode* node = map.find("blocks")) readBlocks(*node, out);
  std::vector<std::string> limits = {"change"};
  for (const Factor& factor : out.factors)
    if (factor.name != out.items && factor.name != out.blockBy) limits.push_back(factor.name);
  if (const YamlNode* node = map.find("order")) out.trialOrder = readOrder(reader_, *node, "order", limits);
  if (const YamlNode* node = map.find("breaks");
      node && reader_.isMap(*node, "'breaks'", "{every_trials: 30}")) {
    reader_.checkKeys(*node, "breaks", {"every_trials"});
    reader_.take(*node, "every_trials", {0, 100000}, "", out.breakEveryTrials);
  }
  if (const YamlNode* node = map.find("practice")) readPractice(*node, out);
  if (const YamlNode* node = map.find("titles")) checkTitles(*node, out);
  checkNames(out, map.mark);
  out.variables["refresh_hz"] = refreshHz_;
  if (const YamlNode* node = map.find("stimulus"))
    out.stimulus.node = *node;
  else
    problems.add(map.mark, "'stimulus' is missing",
                 "give it: {scene: {name: ...}, levels: {before: 1, after: 0}}");
  if (problems.size() == before) checkSize(out, map.mark);
  if (problems.size() == before) checkStimuli(out);
  if (problems.size() == before) {
    const YamlNode* order = map.find("order");
    checkOrders(out, order ? order->mark : map.mark);
  }
  return out;
}

}  // namespace limen::study
