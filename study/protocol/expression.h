// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <vector>

#include "study/protocol/protocol.h"

namespace limen::study {

/// Whether a scalar is an expression: it opens with "=".
bool isExpression(const YamlNode& node);
/// The expression of a scalar that is one.
Expression expressionOf(const YamlNode& node);
/// Names that occur in an expression's text.
std::set<std::string> namesIn(const std::string& text);
/// A letter or "_", then letters, digits and "_".
bool isVariableName(const std::string& name);

/// A tree as JSON: unquoted numbers, true and false as such, all other scalars as text, nothing as null.
nlohmann::json toJson(const YamlNode& node);
/// The tree that toJson() gives this value of, all of it at `mark`.
YamlNode toYaml(const nlohmann::json& value, Mark mark);

}  // namespace limen::study
