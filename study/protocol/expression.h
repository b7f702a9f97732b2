// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <vector>

#include "study/protocol/protocol.h"

namespace limen::study {

/// Whether a scalar is an expression: it starts with "=".
bool isExpression(const YamlNode& node);
/// The expression in such a scalar.
Expression expressionOf(const YamlNode& node);
/// Names that occur in an expression's text.
std::set<std::string> namesIn(const std::string& text);
/// A letter or "_", then letters, digits and "_".
bool isVariableName(const std::string& name);

/// A tree as JSON: unquoted numbers, true and false as such, all other scalars as text, empty nodes as null.
nlohmann::json toJson(const YamlNode& node);
/// The tree for which toJson() gives this value, all of it at `mark`.
YamlNode toYaml(const nlohmann::json& value, Mark mark);

}  // namespace limen::study
