// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <vector>

#include "experiments/base/yaml_json.h"
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

/// The tree for which toJson() gives this value, all of it at `mark`.
YamlNode toYaml(const nlohmann::json& value, Mark mark);

}  // namespace limen::study
