// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "experiments/store/sessions.h"

namespace limen::analysis {

struct StudyFactor {
  std::string name;
  std::vector<std::string> levels;  ///< in order of writing
};

/// What the analysis needs to know of a protocol's part.
struct StudyPart {
  std::string name;
  std::string task;  ///< "yes_no", "interval", "alternative", "rating", "pairwise"
  int alternatives = 2;
  bool adaptive = false;  ///< a procedure chose its stimuli
  std::vector<StudyFactor> factors;

  bool asksYesNo() const { return task == "yes_no"; }
  /// Whether an answer's outcome of 1 is one of two: "yes", or the right one.
  bool isBinary() const { return asksYesNo() || task == "interval" || task == "alternative"; }
};

struct ExclusionRule {
  std::string name;
  double limit = 0.0;
};

/// A protocol as it was stored with its sessions. Only what is named here is read: the protocol was checked
/// when they were run.
struct StudyPlan {
  std::string name, hash, title;
  int widthPx = 1024, heightPx = 768;  ///< of the stimuli's window
  std::vector<StudyPart> parts;
  std::vector<ExclusionRule> exclusions;

  /// Index of a part, which is added as one that asks for nothing known if the text does not have it.
  size_t partNamed(const std::string& name);
};

/// Throws Error on text that is no YAML.
StudyPlan readStudyPlan(const store::StudyProtocol& protocol);

}  // namespace limen::analysis
