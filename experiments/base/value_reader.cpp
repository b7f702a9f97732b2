// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/value_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "experiments/base/error.h"
#include "experiments/base/file_references.h"
#include "experiments/base/text.h"

namespace limen {
namespace {

namespace fs = std::filesystem;

/// std::from_chars takes no plus sign.
std::string_view withoutPlus(const std::string& text) {
  return text.size() > 1 && text[0] == '+' && text[1] != '-' ? std::string_view(text).substr(1) : text;
}

/// The whole text as a number of YAML's core schema in decimal notation; no nan, inf, hexadecimal or
/// thousands separators.
template <class Number>
std::optional<Number> parseNumber(const std::string& text) {
  const std::string_view digits = withoutPlus(text);
  if (digits.empty() || digits.find_first_not_of("0123456789.eE+-") != std::string_view::npos) return {};
  Number number{};
  const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (result.ec != std::errc{} || result.ptr != digits.data() + digits.size()) return {};
  return number;
}

std::optional<ParameterValue> convert(const YamlNode& node, ParameterType type) {
  if (node.kind != YamlNode::Kind::Scalar) return {};
  switch (type) {
    case ParameterType::Choice:
    case ParameterType::Text:
    case ParameterType::File:
      return ParameterValue(node.text);
    case ParameterType::Boolean:
      if (node.quoted || (node.text != "true" && node.text != "false")) return {};
      return ParameterValue(node.text == "true");
    case ParameterType::Integer:
      if (const auto number = parseNumber<int64_t>(node.text); number && !node.quoted)
        return ParameterValue(*number);
      return {};
    case ParameterType::Real:
      if (const auto number = parseNumber<double>(node.text); number && !node.quoted)
        return ParameterValue(*number);
      return {};
    case ParameterType::Group:
      return {};
  }
  return {};
}

/// "'radius' is 'wide'", "'radius' becomes 0.5 by '= size / 2' with size = 1".
std::string sentence(const YamlNode& node, const Parameter& parameter) {
  const std::string is =
      node.origin.empty() ? "is " + node.describe() : "becomes " + node.describe() + " by " + node.origin;
  return "'" + parameter.name + "' " + is;
}

std::string hintFor(const YamlNode& node, const Parameter& parameter) {
  std::string hint = "allowed: " + describeRange(parameter);
  YamlNode unquoted = node;
  unquoted.quoted = false;
  if (node.quoted && convert(unquoted, parameter.type)) hint = "write it without quotes; " + hint;
  const std::string& text = node.text;
  if (parameter.type == ParameterType::Boolean && (text == "yes" || text == "on" || text == "True"))
    hint = "did you mean 'true'? " + hint;
  if (parameter.type == ParameterType::Boolean && (text == "no" || text == "off" || text == "False"))
    hint = "did you mean 'false'? " + hint;
  return hint;
}

}  // namespace

FileFinder::FileFinder(const std::string& descriptorPath) {
  const fs::path folder = fs::path(descriptorPath).parent_path();
  folders_.push_back(folder.empty() ? "." : folder.string());
  folders_.emplace_back(".");
}

std::optional<std::string> FileFinder::find(const std::string& named, Mark mark, Problems& problems) {
  for (const std::string& folder : folders_) {
    std::error_code code;
    const fs::path candidate = fs::path(folder) / named;
    if (!fs::is_regular_file(candidate, code)) continue;
    const std::string path = fs::weakly_canonical(candidate, code).string();
    if (!hashes_.count(path)) {
      try {
        hashes_[path] = sha256WithReferences(path);
      } catch (const Error& error) {
        problems.add(mark, "file '" + named + "' cannot be read", "check its permissions");
        return {};
      }
      asNamed_[path] = named;
    }
    return path;
  }
  std::vector<std::string> neighbours;
  std::error_code code;
  for (fs::directory_iterator entry(fs::path(folders_[0]) / fs::path(named).parent_path(), code), end;
       !code && entry != end && neighbours.size() < 1000; entry.increment(code))
    if (entry->is_regular_file(code)) neighbours.push_back(entry->path().filename().string());
  const std::string nearest = nearestName(fs::path(named).filename().string(), neighbours);
  problems.add(mark, "no file '" + named + "'",
               (nearest.empty() ? "" : "did you mean '" + nearest + "'? ") +
                   "looked in the descriptor's folder (" + folders_[0] + ") and the working directory");
  return {};
}

std::optional<ParameterValue> ValueReader::value(const YamlNode& node, const Parameter& parameter) {
  const auto converted = convert(node, parameter.type);
  if (!converted) {
    problems_.add(node.mark, sentence(node, parameter), hintFor(node, parameter));
    return {};
  }
  try {
    ParameterValue result = validate(parameter, *converted, "");
    if (parameter.type != ParameterType::File) return result;
    auto path = files_.find(std::get<std::string>(result), node.mark, problems_);
    if (!path) return {};
    return ParameterValue(*std::move(path));
  } catch (const Error& error) {
    problems_.add(node.mark, node.origin.empty() ? error.message() : sentence(node, parameter), error.hint());
    return {};
  }
}

bool ValueReader::fits(const YamlNode& node, const Parameter& parameter) {
  const auto converted = convert(node, parameter.type);
  if (!converted) return false;
  try {
    validate(parameter, *converted, "");
    return true;
  } catch (const Error&) {
    return false;
  }
}

std::vector<ParameterValue> ValueReader::values(const YamlNode& node, const Parameter& parameter) {
  std::vector<ParameterValue> out;
  if (node.kind != YamlNode::Kind::List) {
    if (auto single = value(node, parameter)) out.push_back(*std::move(single));
    return out;
  }
  if (node.items.empty())
    problems_.add(
        node.mark, "the list of '" + parameter.name + "' is empty",
        "give at least one value, or leave the parameter out; allowed: " + describeRange(parameter));
  std::map<ParameterValue, int> seen;
  for (const YamlNode& item : node.items) {
    auto single = value(item, parameter);
    if (!single) continue;
    const auto [first, fresh] = seen.emplace(*single, item.mark.line);
    if (!fresh)
      problems_.add(item.mark, fmt::format("'{}' lists {} twice", parameter.name, item.text),
                    "the same run would be planned twice; keep one");
    out.push_back(*std::move(single));
  }
  return out;
}

std::optional<std::string> ValueReader::text(const YamlNode& node, const std::string& key) {
  if (node.kind == YamlNode::Kind::Scalar && !node.text.empty()) return node.text;
  problems_.add(node.mark, "'" + key + "' is " + node.describe(), "allowed: text");
  return {};
}

std::optional<double> ValueReader::number(const YamlNode& node, const std::string& key) {
  if (node.kind == YamlNode::Kind::Scalar && !node.quoted)
    if (const auto number = parseNumber<double>(node.text); number && std::isfinite(*number)) return number;
  problems_.add(node.mark, "'" + key + "' is " + node.describe(), "allowed: a number");
  return {};
}

}  // namespace limen
