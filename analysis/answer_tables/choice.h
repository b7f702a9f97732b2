// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "experiments/base/enum_names.h"
#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen::analysis {

/// The value with that name. Throws Error if there is no such `noun`, with the nearest name.
template <NamedEnum E>
E readChoice(const std::string& name, const std::string& where, const std::string& noun = "choice") {
  const std::vector<std::string> known = namesOf<E>();
  if (std::find(known.begin(), known.end(), name) == known.end())
    throw Error("no " + noun + " '" + name + "'", where, suggest(name, known));
  return fromText<E>(name);
}

}  // namespace limen::analysis
