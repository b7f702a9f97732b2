// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "experiments/base/enum_names.h"
#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen::analysis {

/// Place of a name in a list. Throws Error if there is no such `noun`, with the nearest name.
inline size_t placeOf(const std::string& name, const std::vector<std::string>& known, const std::string& noun,
                      const std::string& where) {
  const auto found = std::find(known.begin(), known.end(), name);
  if (found == known.end()) throw Error("no " + noun + " '" + name + "'", where, suggest(name, known));
  return static_cast<size_t>(found - known.begin());
}

/// The value of that name, with the same error.
template <NamedEnum E>
E readChoice(const std::string& name, const std::string& where, const std::string& noun = "choice") {
  return enumNames(E{}).entries[placeOf(name, namesOf<E>(), noun, where)].value;
}

/// "NAME=VALUE" in two. Throws Error without the sign.
inline std::pair<std::string, std::string> splitAssignment(const std::string& text, const std::string& lacks,
                                                           const std::string& where,
                                                           const std::string& hint) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos) throw Error("'" + text + "' " + lacks, where, hint);
  return {text.substr(0, equals), text.substr(equals + 1)};
}

}  // namespace limen::analysis
