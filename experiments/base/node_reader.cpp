// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/node_reader.h"

#include <algorithm>

#include "experiments/base/entry_reader.h"
#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen {

using Kind = YamlNode::Kind;

bool NodeReader::isMap(const YamlNode& node, const std::string& what, const std::string& example) {
  if (node.kind == Kind::Map) return true;
  problems_.add(node.mark, what + " is " + node.describe(), "write it as a map: " + example);
  return false;
}

bool NodeReader::isFilledList(const YamlNode& node, const std::string& what, const std::string& example) {
  if (node.kind != Kind::List)
    problems_.add(node.mark, what + " is " + node.describe(), "write it as a list: " + example);
  else if (node.items.empty())
    problems_.add(node.mark, "the list of " + what + " is empty", "give at least one: " + example);
  return node.kind == Kind::List && !node.items.empty();
}

void NodeReader::checkKeys(const YamlNode& map, const std::string& what,
                           const std::vector<std::string>& known) {
  for (const auto& [key, value] : map.members)
    if (std::find(known.begin(), known.end(), key.text) == known.end())
      problems_.add(key.mark, "unknown key '" + key.text + "' of " + what,
                    problems_.crowded() ? "" : suggest(key.text, known));
}

std::optional<ParameterValue> NodeReader::number(const YamlNode& node, const std::string& what, Range range,
                                                 const std::string& unit, bool whole) {
  Parameter parameter = settings::state(whole ? ParameterType::Integer : ParameterType::Real, what, {}, {});
  parameter.minimum = range.least;
  parameter.maximum = range.most;
  parameter.unit = unit;
  return values_.value(node, parameter);
}

std::optional<std::string> NodeReader::choice(const YamlNode& node, const std::string& what,
                                              const std::vector<std::string>& names) {
  Parameter parameter = settings::state(ParameterType::Choice, what, {}, {});
  parameter.choices = names;
  const auto value = values_.value(node, parameter);
  return value ? std::optional(std::get<std::string>(*value)) : std::nullopt;
}

void NodeReader::take(const YamlNode& map, const std::string& key, bool& out) {
  const YamlNode* node = map.find(key);
  if (!node) return;
  if (const auto value = values_.value(*node, settings::state(ParameterType::Boolean, key, {}, {})))
    out = std::get<bool>(*value);
}

void NodeReader::takeText(const YamlNode& map, const std::string& key, bool required, std::string& out) {
  const YamlNode* node = map.find(key);
  if (!node && required) problems_.add(map.mark, "'" + key + "' is missing", "give it: text");
  if (node) out = values_.text(*node, key).value_or("");
}

std::vector<std::string> NodeReader::texts(const YamlNode& node, const std::string& what,
                                           const std::string& example) {
  std::vector<std::string> out;
  if (!isFilledList(node, what, example)) return out;
  for (const YamlNode& item : node.items) {
    const auto text = values_.text(item, "an entry of " + what);
    if (!text) continue;
    if (std::find(out.begin(), out.end(), *text) != out.end())
      problems_.add(item.mark, what + " lists '" + *text + "' twice", "keep one");
    else
      out.push_back(*text);
  }
  return out;
}

std::optional<ParameterValues> NodeReader::complete(const YamlNode& map, const std::string& what,
                                                    const std::vector<Parameter>& declared) {
  const size_t before = problems_.size();
  AxisPoint given;
  for (const Axis& axis : EntryReader(*this, "give one value").axes(map, declared, what, {}))
    if (!axis.points.empty()) given.insert(axis.points[0].begin(), axis.points[0].end());
  if (problems_.size() != before) return {};
  return ParameterValues(declared, given);
}

}  // namespace limen
