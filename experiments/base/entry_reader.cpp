// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/entry_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "experiments/base/text.h"

namespace limen {
namespace {

using Kind = YamlNode::Kind;

const char* const kKind = "kind";

/// A choice that expands to more points than this is a mistake, not an axis.
constexpr size_t kMaxPoints = 100'000;

size_t countPoints(const std::vector<Axis>& axes) {
  size_t count = 1;
  for (const Axis& axis : axes) count = std::min(count * axis.points.size(), size_t{1} << 40);
  return count;
}

const Parameter* findParameter(const std::vector<Parameter>& declared, const std::string& name) {
  const auto match = std::find_if(declared.begin(), declared.end(),
                                  [&](const Parameter& parameter) { return parameter.name == name; });
  return match == declared.end() ? nullptr : &*match;
}

std::vector<std::string> namesOf(const std::vector<Parameter>& declared) {
  std::vector<std::string> out;
  for (const Parameter& parameter : declared) out.push_back(parameter.name);
  return out;
}

bool isNumber(const YamlNode& node) {
  return node.kind == Kind::Scalar && !node.quoted && !node.text.empty() &&
         node.text.find_first_not_of("0123456789.eE+-") == std::string::npos &&
         node.text.find_first_of("0123456789") != std::string::npos;
}

/// The parameters below a group, or below the alternative of that name.
const std::vector<Parameter>& membersOf(const Parameter& parameter, const std::string& kind) {
  static const std::vector<Parameter> kNone;
  if (parameter.type == ParameterType::Group) return parameter.alternatives.at(0).parameters;
  const Alternative* alternative = findAlternative(parameter, kind);
  return alternative ? alternative->parameters : kNone;
}

std::string defaultKind(const Parameter& parameter) {
  return parameter.type == ParameterType::Group ? "" : std::get<std::string>(parameter.defaultValue);
}

/// The one path whose value differs among the points, if there is exactly one and all points have it.
std::string varyingPath(const std::vector<AxisPoint>& points) {
  std::set<std::string> varying;
  const auto compare = [&](const AxisPoint& point, const AxisPoint& other) {
    for (const auto& [path, value] : point) {
      const auto match = other.find(path);
      if (match == other.end() || match->second != value) varying.insert(path);
    }
  };
  for (const AxisPoint& point : points) compare(point, points[0]), compare(points[0], point);
  return varying.size() == 1 ? *varying.begin() : "";
}

}  // namespace

std::vector<AxisPoint> combine(const std::vector<Axis>& axes) {
  std::vector<AxisPoint> out = {{}};
  for (const Axis& axis : axes) {
    std::vector<AxisPoint> next;
    for (const AxisPoint& sofar : out)
      for (const AxisPoint& point : axis.points) {
        next.push_back(sofar);
        for (const auto& [path, value] : point) next.back()[path] = value;
      }
    out = std::move(next);
  }
  return out;
}

bool isShorthand(const YamlNode& node, const Parameter& parameter) {
  return !parameter.shorthand.empty() && isNumber(node);
}

const Parameter& shorthandOf(const Parameter& parameter) {
  return *findParameter(membersOf(parameter, defaultKind(parameter)), parameter.shorthand);
}

std::string spell(const DeclaredAt& at) {
  std::string out, path, ends;
  for (size_t begin = 0; begin <= at.path.size();) {
    const size_t end = std::min(at.path.find('.', begin), at.path.size());
    const std::string name = at.path.substr(begin, end - begin);
    path = joinPath(path, name);
    out += name + ": ";
    begin = end + 1;
    if (begin > at.path.size()) break;
    out += "{";
    if (const auto kind = at.when.find(path); kind != at.when.end()) out += "kind: " + kind->second + ", ";
    ends += "}";
  }
  return out + "..." + ends;
}

std::vector<Axis> EntryReader::axes(const YamlNode& map, const std::vector<Parameter>& declared,
                                    const std::string& what, const std::vector<std::string>& others) {
  std::vector<Axis> out;
  root_ = &declared;
  readMap(map, {declared, what, {}, others}, out);
  return out;
}

void EntryReader::readMap(const YamlNode& map, const Level& level, std::vector<Axis>& out) {
  for (const auto& [key, value] : map.members) {
    if (std::find(level.others.begin(), level.others.end(), key.text) != level.others.end()) continue;
    if (const Parameter* parameter = findParameter(level.declared, key.text))
      readParameter(value, *parameter, level, out);
    else
      refuseKey(key, level);
  }
  for (const Parameter& parameter : level.declared)
    if (parameter.required && !map.find(parameter.name))
      reader_.problems().add(map.mark, fmt::format("'{}' of {} is missing", parameter.name, level.what),
                             "give it: " + describeRange(parameter));
}

void EntryReader::refuseKey(const YamlNode& key, const Level& level) {
  const std::string what = fmt::format("{} has no parameter '{}'", level.what, key.text);
  if (reader_.problems().crowded()) return reader_.problems().add(key.mark, what);
  std::vector<std::string> here, present;
  for (const DeclaredAt& at : flatten(*root_)) {
    const std::vector<std::string>& former = at.parameter->formerNames;
    if (std::count(former.begin(), former.end(), key.text) > 0) present.push_back(spell(at));
    const bool isElsewhere = at.path == joinPath(level.path, key.text);
    const bool isInside = level.path.empty() && at.path.ends_with("." + key.text);
    if (isElsewhere || isInside) here.push_back(spell(at));
  }
  if (!present.empty())
    return reader_.problems().add(key.mark, what, "it is now written " + join(present, ", or "));
  // Groups are no part of flatten().
  for (const Parameter& parameter : *root_)
    if (parameter.type == ParameterType::Group &&
        std::count(parameter.formerNames.begin(), parameter.formerNames.end(), key.text))
      here.push_back(parameter.name + ": {...}");
  if (!here.empty())
    return reader_.problems().add(key.mark, what, "did you mean " + join(here, ", or ") + "?");
  std::vector<std::string> known = namesOf(level.declared);
  reader_.problems().add(key.mark, what, known.empty() ? "it has none" : suggest(key.text, known));
}

bool EntryReader::refuseList(const YamlNode& node, const Parameter& parameter, const Level& level) {
  if (listHint_.empty() || node.kind != Kind::List) return false;
  reader_.problems().add(node.mark, fmt::format("'{}' of {} is a list", parameter.name, level.what),
                         listHint_);
  return true;
}

void EntryReader::readParameter(const YamlNode& node, const Parameter& parameter, const Level& level,
                                std::vector<Axis>& out) {
  if (refuseList(node, parameter, level)) return;
  const bool nests = parameter.type == ParameterType::Group || !parameter.alternatives.empty();
  if (!nests) return readPlain(node, parameter, joinPath(level.path, parameter.name), out);
  if (node.kind == Kind::List) return readChoices(node, parameter, level, out);
  readChoice(node, parameter, level, out);
}

void EntryReader::readPlain(const YamlNode& node, const Parameter& parameter, const std::string& path,
                            std::vector<Axis>& out) {
  Axis axis{path, {}};
  for (ParameterValue& value : reader_.values().values(node, parameter))
    axis.points.push_back({{path, std::move(value)}});
  out.push_back(std::move(axis));
}

void EntryReader::readChoice(const YamlNode& node, const Parameter& parameter, const Level& level,
                             std::vector<Axis>& out) {
  const std::string path = joinPath(level.path, parameter.name);
  const bool isGroup = parameter.type == ParameterType::Group;
  const std::string usual = defaultKind(parameter);
  if (isShorthand(node, parameter)) {
    if (!isGroup) out.push_back({path, {{{path, usual}}}});
    const Parameter& member = shorthandOf(parameter);
    return readPlain(node, member, joinPath(path, member.name), out);
  }
  if (node.kind != Kind::Map) {
    if (!isGroup) return readPlain(node, parameter, path, out);
    reader_.problems().add(node.mark, fmt::format("'{}' is {}", parameter.name, node.describe()),
                           "write it as a map of: " + join(namesOf(membersOf(parameter, {}))));
    return;
  }
  std::string kind = usual;
  if (const YamlNode* named = isGroup ? nullptr : node.find(kKind)) {
    if (named->kind == Kind::List) {
      reader_.problems().add(named->mark, fmt::format("'kind' of '{}' is a list", parameter.name),
                             fmt::format("write {}: [{{kind: ...}}, {{kind: ...}}]", parameter.name));
      return;
    }
    const auto value = reader_.values().value(*named, parameter);
    if (!value) return;
    kind = std::get<std::string>(*value);
  }
  if (!isGroup) out.push_back({path, {{{path, kind}}}});
  const std::string what =
      isGroup ? fmt::format("'{}'", parameter.name) : fmt::format("'{}: {}'", parameter.name, kind);
  readMap(node,
          {membersOf(parameter, kind), what + " of " + level.what, path,
           isGroup ? std::vector<std::string>{} : std::vector<std::string>{kKind}},
          out);
}

void EntryReader::readChoices(const YamlNode& list, const Parameter& parameter, const Level& level,
                              std::vector<Axis>& out) {
  const std::string path = joinPath(level.path, parameter.name);
  if (list.items.empty())
    reader_.problems().add(list.mark, "the list of '" + parameter.name + "' is empty",
                           "give at least one value, or leave the parameter out");
  Axis axis{path, {}};
  std::set<AxisPoint> seen;
  for (const YamlNode& item : list.items) {
    if (item.kind == Kind::List) {
      reader_.problems().add(item.mark, fmt::format("an entry of '{}' is a list", parameter.name),
                             "write one list of alternatives");
      continue;
    }
    std::vector<Axis> within;
    readChoice(item, parameter, level, within);
    if (countPoints(within) > kMaxPoints) {
      reader_.problems().add(
          item.mark, fmt::format("'{}' stands for {} combinations", parameter.name, countPoints(within)),
          fmt::format("at most {} are allowed: shorten its lists", kMaxPoints));
      continue;
    }
    for (AxisPoint& point : combine(within)) {
      if (point.empty()) continue;
      if (!seen.insert(point).second)
        reader_.problems().add(item.mark, fmt::format("'{}' lists the same twice", parameter.name),
                               "the same run would be planned twice; keep one");
      axis.points.push_back(std::move(point));
    }
  }
  if (const std::string varying = varyingPath(axis.points); !varying.empty()) axis.name = varying;
  out.push_back(std::move(axis));
}

}  // namespace limen
