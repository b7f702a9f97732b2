// SPDX-License-Identifier: BSD-3-Clause
#include "study/protocol/expression.h"

#include <charconv>
#include <cmath>

#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen::study {
namespace {

using nlohmann::json;

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

/// Recursive descent: sum = product {+|- product}, product = factor {*|/ factor}, factor = [+|-] factor |
/// number | name | ( sum ).
class Parser {
 public:
  Parser(const std::string& text, const Variables& variables, const std::string& where)
      : text_(text), variables_(variables), where_(where) {}

  json value() {
    json out = sum();
    skipBlanks();
    if (at_ < text_.size()) fail("'" + text_.substr(at_) + "' is unexpected");
    if (out.is_number_float()) {
      if (!std::isfinite(out.get<double>())) fail("the result is not a finite number");
      if (out.get<double>() == 0.0) out = 0.0;  // no -0, which would be a different stimulus
    }
    return out;
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& hint = {}) const {
    throw Error(
        "in '=" + text_ + "' " + what, where_,
        hint.empty() ? "an expression consists of numbers, names of variables, + - * / and brackets" : hint);
  }

  void skipBlanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n')) ++at_;
  }

  bool take(char c) {
    skipBlanks();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }

  double number(const json& operand) const {
    if (!operand.is_number()) fail(operand.dump() + " is not a number", "calculate with numbers only");
    return operand.get<double>();
  }

  json sum() {
    json left = product();
    while (true) {
      if (take('+'))
        left = number(left) + number(product());
      else if (take('-'))
        left = number(left) - number(product());
      else
        return left;
    }
  }

  json product() {
    json left = factor();
    while (true) {
      if (take('*')) {
        left = number(left) * number(factor());
      } else if (take('/')) {
        const double divisor = number(factor());
        if (divisor == 0.0) fail("a number is divided by 0", "divide by something that is not 0");
        left = number(left) / divisor;
      } else {
        return left;
      }
    }
  }

  json factor() {
    if (++depth_ > 100) fail("brackets and signs are nested too deeply");
    json out = signedFactor();
    --depth_;
    return out;
  }

  json signedFactor() {
    if (take('-')) return -number(factor());
    if (take('+')) return number(factor());
    if (take('(')) {
      json inner = sum();
      if (!take(')')) fail("a bracket is not closed");
      return inner;
    }
    skipBlanks();
    if (at_ >= text_.size()) fail("something is missing at the end");
    if (isLetter(text_[at_])) return variable();
    if (isDigit(text_[at_]) || text_[at_] == '.') return literal();
    fail("'" + text_.substr(at_, 1) + "' where a number or a name is expected");
  }

  json variable() {
    const size_t begin = at_;
    while (at_ < text_.size() && (isLetter(text_[at_]) || isDigit(text_[at_]))) ++at_;
    const std::string name = text_.substr(begin, at_ - begin);
    const auto found = variables_.find(name);
    if (found != variables_.end()) return found->second;
    std::vector<std::string> known;
    for (const auto& [key, value] : variables_) known.push_back(key);
    throw Error("no variable '" + name + "'", where_, suggest(name, known));
  }

  json literal() {
    double value = 0.0;
    const auto result = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (result.ec != std::errc{}) fail("'" + text_.substr(at_, 1) + "' does not start a number");
    at_ = static_cast<size_t>(result.ptr - text_.data());
    return value;
  }

  const std::string& text_;
  const Variables& variables_;
  const std::string& where_;
  size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

bool isExpression(const YamlNode& node) {
  return node.kind == YamlNode::Kind::Scalar && !node.text.empty() && node.text[0] == '=';
}

Expression expressionOf(const YamlNode& node) { return {nullptr, node.text.substr(1), node.mark}; }

json evaluate(const Expression& expression, const Variables& variables, const std::string& file) {
  if (expression.text.empty() && !expression.constant.is_null()) return expression.constant;
  const std::string where = location(file, expression.mark);
  return Parser(expression.text, variables, where).value();
}

std::set<std::string> namesIn(const std::string& text) {
  std::set<std::string> out;
  for (size_t i = 0; i < text.size();) {
    const size_t begin = i;
    if (isLetter(text[i])) {
      while (i < text.size() && (isLetter(text[i]) || isDigit(text[i]))) ++i;
      out.insert(text.substr(begin, i - begin));
    } else if (isDigit(text[i]) || text[i] == '.') {  // the e of 1e-3 is not a name
      double number = 0.0;
      const auto result = std::from_chars(text.data() + i, text.data() + text.size(), number);
      i = result.ec == std::errc{} ? static_cast<size_t>(result.ptr - text.data()) : i + 1;
    } else {
      ++i;
    }
  }
  return out;
}

bool isVariableName(const std::string& name) {
  if (name.empty() || !isLetter(name[0])) return false;
  for (const char c : name)
    if (!isLetter(c) && !isDigit(c)) return false;
  return true;
}

YamlNode toYaml(const json& value, Mark mark) {
  YamlNode out;
  out.mark = mark;
  if (value.is_null()) return out;
  if (value.is_object()) {
    out.kind = YamlNode::Kind::Map;
    for (const auto& [key, member] : value.items())
      out.members.push_back({toYaml(json(key), mark), toYaml(member, mark)});
  } else if (value.is_array()) {
    out.kind = YamlNode::Kind::List;
    for (const json& item : value) out.items.push_back(toYaml(item, mark));
  } else {
    out.kind = YamlNode::Kind::Scalar;
    out.quoted = value.is_string();
    if (value.is_string())
      out.text = value.get<std::string>();
    else if (value.is_number())
      out.text = value.is_number_integer() ? value.dump() : shortestNumber(value.get<double>());
    else
      out.text = value.dump();
  }
  return out;
}

}  // namespace limen::study
