// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/base/parameter.h"
#include "experiments/executor.h"

namespace limen::viewer {

/// A registered name and those of its parameters that are not at their default.
struct Chosen {
  std::string name;
  std::map<std::string, ParameterValue> given;
  bool operator==(const Chosen&) const = default;
};

/// What is on screen, in a descriptor's terms: what `limen sweep` needs to make the same picture.
struct Choices {
  Chosen scene, technique;
  std::optional<Chosen> other;      ///< a second technique to look at beside the first
  std::optional<Chosen> reference;  ///< of the same kind of product
  glm::ivec2 sizePx{640, 480};
  bool operator==(const Choices&) const = default;
};

/// With all values. Throws Error: unknown name, bad or missing value, values that do not go together.
experiments::Choice completeScene(const Chosen& chosen);
experiments::Choice completeTechnique(const Chosen& chosen);

/// Gives a parameter a value, or takes it away where it is the default. Throws Error if it may not have it.
void give(Chosen& chosen, const Parameter& parameter, const ParameterValue& value);
/// What a control shows: the value given or the default.
const ParameterValue& shown(const Chosen& chosen, const Parameter& parameter);

std::vector<Parameter> sceneParameters(const std::string& name);
std::vector<Parameter> techniqueParameters(const std::string& name);

/// The reference that suits a technique's product: one marked as reference, of the same kind; nothing if
/// there is none.
std::optional<Chosen> usualReference(const std::string& technique);
/// Names of techniques with the same kind of product, references first.
std::vector<std::string> comparable(const std::string& technique);

/// Settings of a reference from cheap to the chosen one, by the parameter by which its error falls
/// (TechniqueInfo::effort), for a figure that gets better and better; the chosen one alone if it has none.
std::vector<Chosen> fromCoarseToFine(const Chosen& reference);

}  // namespace limen::viewer
