// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "experiments/base/parameter.h"

namespace limen::study {

/// What the stimuli of a protocol may name. Protocols and designs depend on this alone, so that they are
/// read and planned without graphics and without the code behind the names.
struct Declaration {
  int version = 1;
  std::vector<Parameter> parameters;
};
struct Declarations {
  std::map<std::string, Declaration> scenes, techniques;
  std::vector<Parameter> shading;  ///< of frame::ShadedSetting
};

/// Contents of the registries; in a library of its own (limen_study_declarations), which needs graphics.
std::shared_ptr<const Declarations> declarationsFromRegistries();

}  // namespace limen::study
