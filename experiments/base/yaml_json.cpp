// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/yaml_json.h"

#include <charconv>
#include <nlohmann/json.hpp>

namespace limen {
namespace {

using nlohmann::json;

/// As YAML's core schema reads decimal numbers.
json scalarToJson(const YamlNode& node) {
  if (node.quoted) return node.text;
  if (node.text == "true" || node.text == "false") return node.text == "true";
  const std::string digits = node.text.size() > 1 && node.text[0] == '+' ? node.text.substr(1) : node.text;
  const char *begin = digits.data(), *end = digits.data() + digits.size();
  if (digits.find_first_not_of("0123456789.eE+-") != std::string::npos) return node.text;
  int64_t whole = 0;
  if (const auto result = std::from_chars(begin, end, whole); result.ec == std::errc{} && result.ptr == end)
    return whole;
  double real = 0.0;
  if (const auto result = std::from_chars(begin, end, real); result.ec == std::errc{} && result.ptr == end)
    return real;
  return node.text;
}

}  // namespace

nlohmann::json toJson(const YamlNode& node) {
  json out;
  switch (node.kind) {
    case YamlNode::Kind::Null:
      break;
    case YamlNode::Kind::Scalar:
      return scalarToJson(node);
    case YamlNode::Kind::List:
      out = json::array();
      for (const YamlNode& item : node.items) out.push_back(toJson(item));
      break;
    case YamlNode::Kind::Map:
      out = json::object();
      for (const auto& [key, value] : node.members) out[key.text] = toJson(value);
      break;
  }
  return out;
}

}  // namespace limen
