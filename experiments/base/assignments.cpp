// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/assignments.h"

#include <algorithm>

#include <charconv>
#include <optional>

#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen {
namespace {

constexpr std::string_view kKindSuffix = ".kind";

template <class Number>
std::optional<ParameterValue> numberOf(const std::string& text) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, value);
  if (code != std::errc{} || stop != end) return {};
  return value;
}

/// The text as a value of the type; none if it is no such value.
std::optional<ParameterValue> typed(ParameterType type, const std::string& text) {
  switch (type) {
    case ParameterType::Boolean:
      if (text == "true" || text == "false") return text == "true";
      return {};
    case ParameterType::Integer:
      return numberOf<int64_t>(text);
    case ParameterType::Real:
      return numberOf<double>(text);
    default:
      return text;
  }
}

struct Assignment {
  std::string path;
  ParameterValue value;
};

Assignment assign(const std::string& path, const std::string& text, const std::vector<DeclaredAt>& known) {
  // One path may stand for parameters of several alternatives; the first that accepts the text is taken. A
  // text that none accepts is passed on for ParameterValues to refuse.
  Assignment out{path, text};
  for (const DeclaredAt& at : known) {
    if (at.path != path) continue;
    const Parameter& parameter = *at.parameter;
    if (parameter.type == ParameterType::Choice && !parameter.shorthand.empty()) {
      const std::string member = joinPath(path, parameter.shorthand);
      for (const DeclaredAt& inner : known)
        if (inner.path == member && numberOf<double>(text)) return assign(member, text, known);
    }
    if (const auto value = typed(parameter.type, text)) {
      out.value = *value;
      return out;
    }
  }
  return out;
}

}  // namespace

std::map<std::string, ParameterValue> readAssignments(const std::vector<std::string>& texts,
                                                      const std::vector<Parameter>& declared,
                                                      const std::string& where) {
  const std::vector<DeclaredAt> known = flatten(declared);
  const auto isKnown = [&](const std::string& path) {
    for (const DeclaredAt& at : known)
      if (at.path == path) return true;
    return false;
  };
  std::map<std::string, ParameterValue> out;
  for (const std::string& text : texts) {
    const size_t split = text.find('=');
    if (split == std::string::npos || split == 0)
      throw Error("'" + text + "' sets nothing", where, "write name=value");
    std::string path = text.substr(0, split);
    if (!isKnown(path) && path.ends_with(kKindSuffix)) path.resize(path.size() - kKindSuffix.size());
    if (!isKnown(path)) {
      std::vector<std::string> names, present;
      for (const DeclaredAt& at : known) {
        names.push_back(at.path);
        const std::vector<std::string>& former = at.parameter->formerNames;
        if (std::count(former.begin(), former.end(), path) > 0) present.push_back("'" + at.path + "'");
      }
      throw Error("no setting '" + path + "'", where,
                  present.empty() ? suggest(path, names) : "it is now " + join(present, ", or "));
    }
    const Assignment one = assign(path, text.substr(split + 1), known);
    if (!out.emplace(one.path, one.value).second)
      throw Error("'" + one.path + "' is set twice", where, "give it once");
  }
  return out;
}

}  // namespace limen
