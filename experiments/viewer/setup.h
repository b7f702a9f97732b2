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

/// A registered name and the parameters that are not at their defaults, by path ("budget.rim").
struct Entry {
  std::string name;
  std::map<std::string, ParameterValue> given;
  bool operator==(const Entry&) const = default;
};

/// What is on screen, in a descriptor's terms: what `limen sweep` needs to make the same picture.
struct ViewSetup {
  Entry scene, technique;
  std::optional<Entry> second;     ///< a second technique to compare with the first
  std::optional<Entry> reference;  ///< of the same kind of product
  glm::ivec2 sizePx{640, 480};
  bool operator==(const ViewSetup&) const = default;
};

/// With all values filled in. Throws Error: unknown name, bad or missing value, values that conflict.
experiments::Configuration completeScene(const Entry& entry);
experiments::Configuration completeTechnique(const Entry& entry);

std::vector<Parameter> sceneParameters(const std::string& name);
const std::vector<Parameter>& techniqueParameters(const std::string& name);
/// With the defaults of the presets that the entry has chosen.
std::vector<Parameter> techniqueParameters(const Entry& entry);
/// Removes values of parameters that do not exist under the entry's choices, as after a change of preset.
void dropAbsent(Entry& entry, const std::vector<Parameter>& declared);

/// The declaration of the parameter at `path` under the alternatives that the entry has chosen; null if there
/// is no such parameter.
const Parameter* findDeclaration(const std::vector<Parameter>& declared, const Entry& entry,
                                 const std::string& path);
/// The given value, or the default.
const ParameterValue& valueAt(const Entry& entry, const std::string& path, const Parameter& parameter);

/// Sets a parameter, or removes its value if that is the default. Choosing another alternative drops the
/// values of the previous one's parameters. Throws Error, the entry unchanged, if there is no such parameter
/// or the value is not allowed.
void setParameter(Entry& entry, const std::vector<Parameter>& declared, const std::string& path,
                  const ParameterValue& value);

/// setParameter() with memory: an alternative chosen again gets back its parameters' values.
class ParameterMemory {
 public:
  void set(Entry& entry, const std::vector<Parameter>& declared, const std::string& path,
           const ParameterValue& value);

 private:
  /// Values of parameters of an alternative, by entry, path and alternative.
  std::map<std::string, std::map<std::string, ParameterValue>> earlier_;
};

/// The reference that suits a technique's product: one marked as reference, of the same kind; nothing if
/// there is none.
std::optional<Entry> usualReference(const std::string& technique);
/// Names of techniques with the same kind of product, references first.
std::vector<std::string> comparable(const std::string& technique);

/// Settings of a reference from cheap to the one given, by the parameter by which its error falls
/// (TechniqueInfo::effort), so that errors can be shown early and refined; the one given alone if it has
/// none.
std::vector<Entry> fromCoarseToFine(const Entry& reference);

}  // namespace limen::viewer
